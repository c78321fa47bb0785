#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace cpslam {

/// "640x480".
[[nodiscard]] std::string size_text(cv::Size size);

/// Throws InputError saying what is wrong with a pair of images: empty, sizes that differ from the expected
/// one or from each other, types other than 8 bits in one or three channels for colour, 16-bit integers or
/// 32-bit floats for depth.
void check_images(const cv::Mat& colour, const cv::Mat& depth, cv::Size expected);

}  // namespace cpslam
