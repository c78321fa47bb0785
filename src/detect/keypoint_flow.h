#pragma once

#include <Eigen/Core>
#include <vector>

#include "camera/pinhole_camera.h"
#include "detect/person_fit.h"
#include "features/descriptor.h"

namespace cpslam {

/// The keypoints of a frame, those on people included. The vectors are parallel.
struct FlowKeypoints {
  std::vector<DepthKeypoint> keypoints;
  std::vector<Descriptor> descriptors;
};

/// Where a keypoint with depth lies in the camera frame (m).
[[nodiscard]] Eigen::Vector3f lift(const PinholeCamera& camera, const DepthKeypoint& k);

/// Finds the keypoints of an earlier frame again in this one. Keeps references to both arguments.
class KeypointFlow {
 public:
  KeypointFlow(const PinholeCamera& camera, const FlowKeypoints& current);

  /// Index of the keypoint with depth that looks like `descriptor` near where a point (m, in this frame's
  /// camera frame) is expected, -1 when none or several do, or it is not before the camera.
  [[nodiscard]] int find(const Eigen::Vector3f& expected, const Descriptor& descriptor) const;

 private:
  const PinholeCamera& camera_;
  const FlowKeypoints& current_;
  std::vector<std::size_t> by_row_;  // keypoints with depth, from the top down
};

}  // namespace cpslam
