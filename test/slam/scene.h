#pragma once

#include <vector>

#include "map/map.h"
#include "slam/frame.h"
#include "slam/rig.h"
#include "support/synthetic.h"

/// Small maps of known truth.
namespace cpslam::scene {

inline const Rig kRig(synthetic::settings());

inline KeyFrameId add_keyframe(Map& map, const synthetic::View& view) {
  KeyFrame keyframe;
  keyframe.features = view.features;
  keyframe.cam_from_world = view.cam_from_world;
  return map.add_keyframe(std::move(keyframe));
}

inline Frame make_frame(const synthetic::View& view, double time_s = 0.0) {
  Frame frame;
  frame.time_s = time_s;
  frame.features = view.features;
  frame.cam_from_world = view.cam_from_world;
  frame.matches.resize(view.point_of.size());
  return frame;
}

/// A world, cameras that look at it, and a map of exact poses and points with all observations.
struct MappedWorld {
  synthetic::World world;
  std::vector<synthetic::View> views;
  Map map{kRig.pyramid};
  std::vector<KeyFrameId> keyframes;  ///< parallel to views
  std::vector<MapPointId> points;     ///< parallel to world.points; invalid where nobody looks

  MappedWorld(std::size_t n_points, const std::vector<SE3>& poses, const synthetic::ViewOptions& options,
              Random& random, double min_depth_m = 1.2, double max_depth_m = 2.8)
      : world(synthetic::random_world(n_points, random, min_depth_m, max_depth_m)), points(n_points) {
    for (const SE3& pose : poses) add_view(pose, options, random);
  }

  /// Adds a keyframe that sees all points in its image, but for the first `unlinked` of them.
  KeyFrameId add_view(const SE3& cam_from_world, const synthetic::ViewOptions& options, Random& random,
                      std::size_t unlinked = 0) {
    views.push_back(synthetic::look(world, cam_from_world, options, random));
    const KeyFrameId id = add_keyframe(map, views.back());
    keyframes.push_back(id);
    for (std::size_t p = unlinked; p < world.points.size(); ++p) {
      const int keypoint = views.back().keypoint_of[p];
      if (keypoint < 0) continue;
      if (points[p].valid()) {
        map.add_observation(points[p], {id, keypoint});
        map.refresh_point(points[p]);
      } else {
        points[p] = map.add_point(world.points[p], {id, keypoint});
      }
    }
    map.update_covisibility(id);
    return id;
  }

  /// Moves all keyframes but the first and all points off their places.
  void disturb(Random& random) {
    for (std::size_t k = 1; k < keyframes.size(); ++k) {
      const SE3 error(so3_exp(0.01 * Eigen::Vector3d(random.normal(), random.normal(), random.normal())),
                      0.02 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
      map.set_pose(keyframes[k], error * views[k].cam_from_world);
    }
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Eigen::Vector3d error(random.normal(), random.normal(), random.normal());
      map.set_position(points[p], world.points[p] + 0.02 * error);
    }
  }

  /// A frame at `pose`, without matches.
  Frame frame_at(const SE3& pose, const synthetic::ViewOptions& options, Random& random) {
    return make_frame(synthetic::look(world, pose, options, random));
  }
};

/// n poses in a row along x, `step_m` apart, all looking ahead.
inline std::vector<SE3> row_of_poses(std::size_t n, double step_m) {
  std::vector<SE3> poses;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = step_m * static_cast<double>(i);
    poses.push_back(synthetic::moved({}, {x, 0.2 * x, 0.1 * x}, -0.2 * x));
  }
  return poses;
}

}  // namespace cpslam::scene
