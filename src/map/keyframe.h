#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "features/frame_features.h"
#include "geometry/se3.h"
#include "map/ids.h"

namespace cpslam {

/// An edge of the covisibility graph.
struct Covisible {
  KeyFrameId keyframe;
  int shared_points = 0;
};

/// A frame that stays in the map. Plain data: Map keeps the links between keyframes and points consistent.
struct KeyFrame {
  std::uint64_t sequence = 0;  ///< order of creation; never used again, unlike slots
  int session = 1;             ///< in whose world the pose is; see Map
  double time_s = 0.0;
  SE3 cam_from_world;
  std::shared_ptr<const FrameFeatures> features;
  std::vector<MapPointId> points;    ///< parallel to the keypoints; invalid where a keypoint has no map point
  std::vector<Covisible> covisible;  ///< most shared points first, then the older keyframe
  KeyFrameId parent;                 ///< in the spanning tree; invalid for the root
  std::vector<KeyFrameId> children;
  std::vector<KeyFrameId> loops;  ///< recognised as the same place although no track of points led there

  [[nodiscard]] Eigen::Vector3d centre_in_world() const {
    return -(cam_from_world.rotation.transpose() * cam_from_world.translation);
  }
};

}  // namespace cpslam
