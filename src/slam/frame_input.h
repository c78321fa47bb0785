#pragma once

#include <opencv2/core/mat.hpp>

#include "util/log.h"

namespace cpslam {

/// 8-bit grey of a colour image in B,G,R or of a grey one.
[[nodiscard]] cv::Mat to_grey(const cv::Mat& colour);

/// Median of the valid depths in metres; 0 when there is none.
[[nodiscard]] double median_depth_m(const cv::Mat& depth, double depth_map_factor);

/// Warns when the median depth of a scene says that DepthMapFactor must be wrong.
void warn_about_depth_scale(const cv::Mat& depth, double depth_map_factor, const Log& log);

}  // namespace cpslam
