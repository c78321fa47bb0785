#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace cpslam {

/// Keypoints keep this distance (px) from the border of their level: 15 px of orientation patch or 18 px of
/// rotated pattern, and one for the rounding.
inline constexpr int kOrbBorderPx = 19;

/// Scaled copies of an 8-bit image, level i being 1 / scale_factor^i of the input's size (rounded), each
/// resized bilinearly from the one before. Rows are padded: kernels may read kPaddingPx past the end of any
/// row. Memory is kept between calls.
class ImagePyramid {
 public:
  static constexpr int kPaddingPx = 64;

  ImagePyramid(double scale_factor, int n_levels);

  void build(const cv::Mat& grey);
  /// Levels that are large enough to hold a keypoint; may be 0 for a tiny image.
  [[nodiscard]] int n_levels() const { return n_used_; }
  [[nodiscard]] const cv::Mat& level(int i) const { return levels_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] float scale(int i) const { return scales_[static_cast<std::size_t>(i)]; }

 private:
  void allocate(cv::Size size);

  std::vector<float> scales_;
  std::vector<std::vector<std::uint8_t>> memory_;
  std::vector<cv::Mat> levels_;  // headers over memory_
  cv::Size size_;
  int n_used_ = 0;
};

}  // namespace cpslam
