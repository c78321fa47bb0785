#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "camera/pinhole_camera.h"
#include "cpslam/settings.h"
#include "features/frame_features.h"
#include "features/scale_pyramid.h"
#include "geometry/se3.h"
#include "util/random.h"

/// FrameFeatures of known geometry, for the tests of the rooms above features.
namespace cpslam::synthetic {

inline Settings settings() {
  Settings s;
  s.camera.fx = 525.0;
  s.camera.fy = 520.0;
  s.camera.cx = 319.5;
  s.camera.cy = 239.5;
  s.camera.fps = 30.0;
  s.camera.bf = 40.0;
  return s;
}

inline ScalePyramid pyramid() {
  return {settings().orb.scale_factor, settings().orb.n_levels};
}

/// Two of these differ in about 128 bits.
inline Descriptor random_descriptor(Random& random) {
  Descriptor descriptor;
  for (auto& word : descriptor.words) word = random.next();
  return descriptor;
}

/// The descriptor with n bits turned over, from bit `first` on.
inline Descriptor flipped(Descriptor descriptor, int n, int first = 0) {
  for (int bit = first; bit < first + n; ++bit) {
    descriptor.words[static_cast<std::size_t>(bit / 64)] ^= std::uint64_t{1} << (bit % 64);
  }
  return descriptor;
}

struct Spot {
  double x = 0.0;  ///< undistorted px
  double y = 0.0;
  Descriptor descriptor;
  double depth_m = 0.0;  ///< 0: none
  int octave = 0;
  float angle_deg = 0.0F;
};

inline std::shared_ptr<FrameFeatures> make_features(std::span<const Spot> spots) {
  const PinholeCamera camera(settings().camera);
  auto features = std::make_shared<FrameFeatures>();
  for (const Spot& spot : spots) {
    features->keypoints.push_back(
        {static_cast<float>(spot.x), static_cast<float>(spot.y), spot.angle_deg, 50.0F, spot.octave});
    features->descriptors.push_back(spot.descriptor);
    const bool depth = spot.depth_m > 0.0;
    features->depth_m.push_back(static_cast<float>(spot.depth_m));
    features->disparity_px.push_back(depth ? static_cast<float>(camera.bf() / spot.depth_m) : 0.0F);
    features->depth_sigma_m.push_back(depth ? 0.005F : 0.0F);
  }
  features->grid = KeypointGrid(features->keypoints, camera.undistorted_bounds());
  return features;
}

/// Points that a camera at the origin sees, each with a look of its own.
struct World {
  std::vector<Eigen::Vector3d> points;
  std::vector<Descriptor> descriptors;
  std::vector<double> reference_distance_m;  ///< where the point shows at octave 2
};

inline World random_world(std::size_t n, Random& random, double min_depth_m = 1.2, double max_depth_m = 2.8) {
  const PinholeCamera camera(settings().camera);
  World world;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d px(random.uniform(20.0, 620.0), random.uniform(20.0, 460.0));
    world.points.push_back(camera.back_project(px, random.uniform(min_depth_m, max_depth_m)));
    world.descriptors.push_back(random_descriptor(random));
    world.reference_distance_m.push_back(world.points.back().norm());
  }
  return world;
}

struct ViewOptions {
  double depth_share = 1.0;  ///< of the keypoints that have depth
  double noise_px = 0.0;     ///< standard deviation of x and y, at level 0
  int bit_flips = 0;         ///< per descriptor, at a random place
};

/// What a camera sees of a world, in a shuffled order.
struct View {
  SE3 cam_from_world;
  std::shared_ptr<const FrameFeatures> features;
  std::vector<int> point_of;     ///< by keypoint
  std::vector<int> keypoint_of;  ///< by point of the world; -1 where it is not seen
};

inline View look(const World& world, const SE3& cam_from_world, const ViewOptions& options, Random& random) {
  const PinholeCamera camera(settings().camera);
  const ScalePyramid levels = pyramid();
  View view;
  view.cam_from_world = cam_from_world;
  view.keypoint_of.assign(world.points.size(), -1);
  std::vector<std::size_t> order(world.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
  std::vector<Spot> spots;
  for (const std::size_t i : order) {
    const Eigen::Vector3d in_camera = cam_from_world * world.points[i];
    if (in_camera.z() < 0.1) continue;
    const Eigen::Vector2d uv = camera.project(in_camera);
    if (!camera.in_image(uv)) continue;
    Spot spot;
    // The farther away, the finer the level at which a point looks the same.
    const double ratio = world.reference_distance_m[i] / in_camera.norm();
    const int octave = 2 + static_cast<int>(std::lround(std::log(ratio) / levels.log_factor));
    spot.octave = std::clamp(octave, 0, levels.n_levels() - 1);
    spot.x = uv.x() + options.noise_px * random.normal();
    spot.y = uv.y() + options.noise_px * random.normal();
    const int first_bit = static_cast<int>(random.index(static_cast<std::size_t>(257 - options.bit_flips)));
    spot.descriptor = flipped(world.descriptors[i], options.bit_flips, first_bit);
    if (random.uniform() < options.depth_share) spot.depth_m = in_camera.z();
    view.keypoint_of[i] = static_cast<int>(spots.size());
    view.point_of.push_back(static_cast<int>(i));
    spots.push_back(spot);
  }
  view.features = make_features(spots);
  return view;
}

/// A pose `translation` away from `from` (in its camera's frame) and turned by `rotation_rad` about y.
inline SE3 moved(const SE3& from, const Eigen::Vector3d& translation, double rotation_rad = 0.0) {
  return SE3(so3_exp({0.0, rotation_rad, 0.0}), -translation) * from;
}

/// Size of the difference of two poses: metres and radians together.
inline double distance(const SE3& a, const SE3& b) {
  return (a * b.inverse()).log().norm();
}

}  // namespace cpslam::synthetic
