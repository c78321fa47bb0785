#pragma once

#include <array>
#include <memory>

#include "geometry/se3.h"
#include "util/random.h"

namespace cpslam::sim {

enum class PathKind { kStatic, kXyz, kRpy, kHalfsphere, kRounds, kRingTour, kTwins };

/// How a camera is carried: its pose at any time. Immutable. World frame z up; the camera looks along its +z,
/// x right, y down.
class CameraPath {
 public:
  virtual ~CameraPath() = default;
  [[nodiscard]] virtual SE3 world_from_camera(double time_s) const = 0;
};

/// static: a few millimetres of sway; xyz: +-0.5 m in all directions; rpy: +-25 degrees about all axes;
/// halfsphere: 1 m around the desk; rounds: round and round the office's desks; ring: once through six rooms
/// and on; twins: to and fro between two desks. Phases and amplitudes come from the generator.
[[nodiscard]] std::unique_ptr<CameraPath> make_camera_path(PathKind kind, Random& random);

/// Pose at a position with the optical axis along forward, the image upright.
[[nodiscard]] SE3 looking_along(const Eigen::Vector3d& position, const Eigen::Vector3d& forward);

}  // namespace cpslam::sim
