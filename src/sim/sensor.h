#pragma once

#include <opencv2/core.hpp>

#include "cpslam/settings.h"
#include "sim/rasterizer.h"
#include "util/random.h"

namespace cpslam::sim {

/// Range of the simulated structured-light sensor, m.
inline constexpr double kNearestDepth_m = 0.4;
inline constexpr double kFarthestDepth_m = 8.0;

/// Exact depth in units of depth_map_factor, CV_16UC1; 0 where there is nothing or beyond 16 bits.
[[nodiscard]] cv::Mat exact_depth(const cv::Mat& depth_m, double depth_map_factor);

/// Depth as a structured-light sensor gives it, CV_16UC1 in units of camera.depth_map_factor: disparity bf /
/// z quantised to 1/8 px (Khoshelham and Elberink 2012), axial noise (Nguyen et al. 2012) whose standard
/// deviation with the quantisation is structured_light_sigma_m and which neighbouring pixels share, ragged
/// object edges, no depth where the projector is hidden, at grazing angles, on glass and out of range.
[[nodiscard]] cv::Mat structured_light_depth(const RenderedView& view, const CameraSettings& camera,
                                             Random& random);

/// 8-bit picture from a rendered one (CV_32FC3): gain, then, with noise, photon and readout noise of a small
/// sensor, sqrt(1 + 0.02 * value) grey levels.
[[nodiscard]] cv::Mat develop_colour(const cv::Mat& colour_bgr, double gain, bool noise, Random& random);

}  // namespace cpslam::sim
