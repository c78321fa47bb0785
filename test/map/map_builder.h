#pragma once

#include <memory>
#include <vector>

#include "map/map.h"
#include "support/synthetic.h"

namespace cpslam::test {

/// Features of n keypoints in a row, all with depth or none.
inline std::shared_ptr<const FrameFeatures> blank_features(std::size_t n, bool depth = true) {
  Random random(n);
  std::vector<synthetic::Spot> spots(n);
  for (std::size_t i = 0; i < n; ++i) {
    spots[i].x = 10.0 * static_cast<double>(i % 60);
    spots[i].y = 10.0 * static_cast<double>(i / 60 % 45);
    spots[i].depth_m = depth ? 2.0 : 0.0;
    spots[i].descriptor = synthetic::random_descriptor(random);
  }
  return synthetic::make_features(spots);
}

inline KeyFrameId add_keyframe(Map& map, std::shared_ptr<const FrameFeatures> features,
                               const SE3& cam_from_world = {}) {
  KeyFrame keyframe;
  keyframe.features = std::move(features);
  keyframe.cam_from_world = cam_from_world;
  return map.add_keyframe(std::move(keyframe));
}

/// Makes the two keyframes share n new points, on their first free keypoints.
inline std::vector<MapPointId> share_points(Map& map, KeyFrameId a, KeyFrameId b, std::size_t n) {
  const auto free_keypoint = [&](KeyFrameId id) {
    const auto& points = map.keyframe(id)->points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].valid()) return static_cast<int>(i);
    }
    return -1;
  };
  std::vector<MapPointId> points;
  for (std::size_t i = 0; i < n; ++i) {
    points.push_back(map.add_point({0.1 * static_cast<double>(i), 0.0, 2.0}, {a, free_keypoint(a)}));
    map.add_observation(points.back(), {b, free_keypoint(b)});
  }
  return points;
}

inline int shared_points_of_edge(const Map& map, KeyFrameId from, KeyFrameId to) {
  for (const Covisible& edge : map.keyframe(from)->covisible) {
    if (edge.keyframe == to) return edge.shared_points;
  }
  return 0;
}

}  // namespace cpslam::test
