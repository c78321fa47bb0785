#pragma once

#include <opencv2/core/mat.hpp>

#include "cpslam/settings.h"
#include "util/log.h"

namespace cpslam {

/// Throws InputError saying what is wrong with a pair of images: empty, sizes that differ from the settings'
/// or from each other, types other than System::track takes.
void check_images(const cv::Mat& colour, const cv::Mat& depth, const CameraSettings& camera);

/// 8-bit grey of a colour image in B,G,R or of a grey one.
[[nodiscard]] cv::Mat to_grey(const cv::Mat& colour);

/// Median of the valid depths in metres; 0 when there is none.
[[nodiscard]] double median_depth_m(const cv::Mat& depth, double depth_map_factor);

/// Warns when the median depth of a scene says that DepthMapFactor must be wrong.
void warn_about_depth_scale(const cv::Mat& depth, double depth_map_factor, const Log& log);

}  // namespace cpslam
