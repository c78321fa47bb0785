#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "detect/grid_camera.h"
#include "geometry/se3.h"

namespace cpslam {

/// For how many frames the surface at each cell has not moved against the room, as far as depths tell: up to
/// 250. Ages are carried from frame to frame by the camera's motion; where something else shows than was
/// expected they begin at 0, where nothing was known at kUnknownStillAge.
[[nodiscard]] cv::Mat1b carry_still_age(const GridCamera& camera, const cv::Mat1f& previous_depth_m,
                                        const cv::Mat1b& previous_age, const cv::Mat1f& depth_m,
                                        const SE3& this_from_previous);

inline constexpr std::uint8_t kUnknownStillAge = 8;
/// From this age on a surface counts as still.
inline constexpr std::uint8_t kStillAge = 12;

/// How far a reading of a still surface may be from what another frame predicts (m).
[[nodiscard]] float still_tolerance_m(float depth_m);

}  // namespace cpslam
