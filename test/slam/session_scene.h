#pragma once

#include <vector>

#include "slam/loop_scene.h"

/// Sessions that looked about in a round world, or in two of which a part looks the same.
namespace cpslam::scene {

inline double azimuth_of(const Eigen::Vector3d& point) {
  return std::atan2(point.x(), point.z());
}

/// The same within `half_rad` of an azimuth, another one elsewhere.
inline synthetic::World twin_of(const synthetic::World& world, double azimuth, double half_rad,
                                Random& random) {
  const synthetic::World other = round_world(world.points.size(), random);
  synthetic::World twin = world;
  for (std::size_t i = 0; i < world.points.size(); ++i) {
    if (std::abs(azimuth_of(world.points[i]) - azimuth) < half_rad) continue;
    if (std::abs(azimuth_of(other.points[i]) - azimuth) < half_rad) {
      twin.points[i].setConstant(1000.0);  // out of sight
      continue;
    }
    twin.points[i] = other.points[i];
    twin.descriptors[i] = other.descriptors[i];
    twin.reference_distance_m[i] = other.reference_distance_m[i];
  }
  return twin;
}

struct Sessions {
  static constexpr double kStepRad = std::numbers::pi / 12.0;

  /// Adds a session of keyframes kStepRad apart, in a world of its own that is exact.
  std::vector<KeyFrameId> add(const synthetic::World& world, int first_step, int last_step,
                              const SE3& session_from_world) {
    const int session = map.sessions_created() + 1;
    std::vector<KeyFrameId> ids;
    std::vector<MapPointId> points(world.points.size());
    for (int step = first_step; step <= last_step; ++step) {
      const SE3 true_pose = outward_pose(kStepRad * step);
      const synthetic::View view =
          synthetic::look(world, true_pose, {.noise_px = 0.2, .bit_flips = 10}, random);
      KeyFrame keyframe;
      keyframe.session = session;
      keyframe.time_s = static_cast<double>(map.n_keyframes());
      keyframe.features = view.features;
      keyframe.cam_from_world = true_pose * session_from_world.inverse();
      ids.push_back(map.add_keyframe(std::move(keyframe)));
      for (std::size_t p = 0; p < points.size(); ++p) {
        if (view.keypoint_of[p] < 0) continue;
        const Observation seen{ids.back(), view.keypoint_of[p]};
        if (!points[p].valid()) {
          points[p] = map.add_point(session_from_world * world.points[p], seen);
        } else {
          map.add_observation(points[p], seen);
          map.refresh_point(points[p]);
        }
      }
      map.update_covisibility(ids.back());
      true_poses.push_back(true_pose);
      features.push_back(view.features);
      keyframes.push_back(ids.back());
    }
    return ids;
  }

  [[nodiscard]] LoopEdge edge(KeyFrameId current, KeyFrameId matched) const {
    return {current, matched, true_pose(current) * true_pose(matched).inverse()};
  }
  [[nodiscard]] const SE3& true_pose(KeyFrameId id) const { return true_poses[index(id)]; }
  [[nodiscard]] std::size_t index(KeyFrameId id) const {
    return static_cast<std::size_t>(std::find(keyframes.begin(), keyframes.end(), id) - keyframes.begin());
  }

  Random random{71};
  Map map{kRig.pyramid};
  std::vector<KeyFrameId> keyframes;
  std::vector<SE3> true_poses;  ///< parallel to keyframes
  std::vector<std::shared_ptr<const FrameFeatures>> features;
};

inline const SE3 kElsewhere(so3_exp({0.3, 2.0, -0.1}), {4.0, -1.0, 7.0});

}  // namespace cpslam::scene
