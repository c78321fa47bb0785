#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "cpslam/error.h"

namespace cpslam {

/// The picture with three channels, B,G,R: itself, or a grey one as a colourless one. Throws InputError for
/// any other type, and for an empty one.
[[nodiscard]] inline cv::Mat to_bgr(const cv::Mat& colour) {
  if (colour.empty()) throw InputError("the detector was given an empty image");
  if (colour.type() == CV_8UC3) return colour;
  if (colour.type() != CV_8UC1) throw InputError("the detector takes CV_8UC3 or CV_8UC1 images");
  cv::Mat bgr;
  cv::cvtColor(colour, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

}  // namespace cpslam
