#pragma once

namespace cpslam {

/// Standard deviation (m) of a structured-light depth reading at depth_m: Nguyen, Izadi and Lovell 2012,
/// axial noise of the first Kinect at moderate surface angles.
[[nodiscard]] constexpr double structured_light_sigma_m(double depth_m) {
  const double from_nearest = depth_m - 0.4;
  return 0.0012 + 0.0019 * from_nearest * from_nearest;
}

}  // namespace cpslam
