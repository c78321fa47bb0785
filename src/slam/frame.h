#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "features/frame_features.h"
#include "geometry/se3.h"
#include "map/ids.h"

namespace cpslam {

/// The 3-D point a keypoint was matched to.
struct PointMatch {
  enum class Kind : std::uint8_t {
    kNone,
    kMapPoint,
    kTemporary,  ///< back-projected from one frame's depth to help with the next; never enters the map
  };
  Kind kind = Kind::kNone;
  MapPointId id;  ///< of a kMapPoint
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
};

/// A frame on its way through Tracking.
struct Frame {
  std::uint64_t index = 0;
  double time_s = 0.0;
  std::shared_ptr<const FrameFeatures> features;
  SE3 cam_from_world;
  std::vector<PointMatch> matches;  ///< parallel to the keypoints
};

}  // namespace cpslam
