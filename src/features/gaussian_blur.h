#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "features/simd.h"

namespace cpslam {

/// 7 x 7 Gaussian blur with sigma 2 px and mirrored borders (dcb|abcd|cba), in exact fixed-point arithmetic:
/// equal to cv::GaussianBlur of OpenCV 4 to the bit. Memory is kept between calls.
class GaussianBlur {
 public:
  explicit GaussianBlur(Simd simd = best_simd()) : simd_(simd) {}
  /// image: CV_8UC1, at least 4 px wide and high, rows padded as ImagePyramid's are. The result is padded
  /// too, and is valid until the next call.
  const cv::Mat& blur(const cv::Mat& image);

 private:
  Simd simd_;
  std::vector<std::uint8_t> memory_;
  std::vector<std::uint16_t> sum_;  // one vertically blurred row, with mirrored margins
  cv::Mat result_;                  // header over memory_
  // exp(-d^2 / 8) for distances d of 0 to 3, normalised, in 1/128, rounded as OpenCV does so that the kernel
  // sums to 1. Not constants: the compiler would make slow chains of shifts and additions of the
  // multiplications.
  std::array<std::uint16_t, 4> weights_{28, 24, 17, 9};
};

}  // namespace cpslam
