#pragma once

#include <algorithm>
#include <vector>

#include "optim/bundle_adjuster.h"
#include "optim/pose_solver.h"
#include "util/random.h"

/// Made-up scenes with known truth, for the tests and the benchmark of src/optim.
namespace cpslam::scenes {

inline ReprojectionCamera camera() {
  return {525.0, 520.0, 319.5, 239.5, 40.0};
}

inline Eigen::Matrix<double, 6, 1> random_twist(double translation_m, double rotation_rad, Random& random) {
  Eigen::Matrix<double, 6, 1> twist;
  for (int i = 0; i < 6; ++i) twist[i] = random.normal();
  twist.head<3>() *= translation_m / twist.head<3>().norm();
  twist.tail<3>() *= rotation_rad / twist.tail<3>().norm();
  return twist;
}

/// What the camera sees of a point in its own frame; noise_scale times the sigmas of normal noise.
inline PointObservation observe(const Eigen::Vector3d& p, bool depth, double noise_scale, Random& random) {
  const ReprojectionCamera c = camera();
  PointObservation seen;
  seen.sigma_px = random.uniform(0.8, 2.0);
  seen.sigma_disparity_px = random.uniform(0.3, 1.0);
  seen.uv.x() = c.fx * p.x() / p.z() + c.cx + noise_scale * seen.sigma_px * random.normal();
  seen.uv.y() = c.fy * p.y() / p.z() + c.cy + noise_scale * seen.sigma_px * random.normal();
  if (depth) {
    seen.disparity = std::max(0.0, c.bf / p.z() + noise_scale * seen.sigma_disparity_px * random.normal());
  }
  return seen;
}

/// A point that projects into a 640 x 480 image, 0.6 to 5 m before the camera.
inline Eigen::Vector3d visible_point(Random& random) {
  const ReprojectionCamera c = camera();
  const double z = random.uniform(0.6, 5.0);
  return {(random.uniform(0.0, 640.0) - c.cx) / c.fx * z, (random.uniform(0.0, 480.0) - c.cy) / c.fy * z, z};
}

inline std::vector<PoseObservation> frame(const SE3& cam_from_world, std::size_t n, double depth_ratio,
                                          double noise_scale, Random& random) {
  std::vector<PoseObservation> observations(n);
  for (PoseObservation& observation : observations) {
    const Eigen::Vector3d p = visible_point(random);
    observation.point_in_world = cam_from_world.inverse() * p;
    observation.seen = observe(p, random.uniform() < depth_ratio, noise_scale, random);
  }
  return observations;
}

struct BundleScene {
  BundleProblem truth;  ///< exact poses and points, noisy observations
  BundleProblem start;  ///< free poses and all points disturbed
};

/// A camera that walks round a cloud of points; every point is seen from views_per_point poses in a row.
struct BundleSceneOptions {
  std::size_t poses = 8;
  std::size_t fixed = 2;
  std::size_t points = 300;
  std::size_t views_per_point = 4;
  double depth_ratio = 0.8;
  double noise_scale = 1.0;
  double pose_error_m = 0.03;
  double pose_error_rad = 0.02;
  double point_error_m = 0.03;
};

inline BundleScene bundle_scene(const BundleSceneOptions& options, Random& random) {
  BundleScene scene;
  BundleProblem& truth = scene.truth;
  truth.camera = camera();
  for (std::size_t i = 0; i < options.poses; ++i) {
    Eigen::Matrix<double, 6, 1> twist = random_twist(0.05, 0.03, random);
    twist[0] += 0.08 * static_cast<double>(i);
    truth.cam_from_world.push_back(SE3::exp(twist));
    truth.pose_fixed.push_back(i < options.fixed ? 1 : 0);
  }
  for (std::size_t point = 0; point < options.points; ++point) {
    const std::size_t first = random.index(options.poses - options.views_per_point + 1);
    const std::size_t middle = first + options.views_per_point / 2;
    const Eigen::Vector3d in_world = truth.cam_from_world[middle].inverse() * visible_point(random);
    truth.point_in_world.push_back(in_world);
    for (std::size_t pose = first; pose < first + options.views_per_point; ++pose) {
      const Eigen::Vector3d in_cam = truth.cam_from_world[pose] * in_world;
      const bool depth = random.uniform() < options.depth_ratio;
      truth.observations.push_back({static_cast<int>(pose), static_cast<int>(point),
                                    observe(in_cam, depth, options.noise_scale, random)});
    }
  }
  scene.start = truth;
  for (std::size_t i = options.fixed; i < options.poses; ++i) {
    scene.start.cam_from_world[i] =
        SE3::exp(random_twist(options.pose_error_m, options.pose_error_rad, random)) *
        truth.cam_from_world[i];
  }
  for (Eigen::Vector3d& point : scene.start.point_in_world) {
    point += options.point_error_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  }
  return scene;
}

}  // namespace cpslam::scenes
