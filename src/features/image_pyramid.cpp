#include "features/image_pyramid.h"

#include <opencv2/imgproc.hpp>

#include "features/scale_pyramid.h"

namespace cpslam {

ImagePyramid::ImagePyramid(double scale_factor, int n_levels)
    : scales_(ScalePyramid(scale_factor, n_levels).factor),
      memory_(scales_.size()),
      levels_(scales_.size()) {}

void ImagePyramid::build(const cv::Mat& grey) {
  if (grey.size() != size_) allocate(grey.size());
  if (n_used_ == 0) return;
  // Level 0 is copied for the padding; that also makes views and user memory harmless.
  grey.copyTo(levels_[0]);
  for (int i = 1; i < n_used_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    cv::resize(levels_[k - 1], levels_[k], levels_[k].size(), 0.0, 0.0, cv::INTER_LINEAR);
  }
}

void ImagePyramid::allocate(cv::Size size) {
  size_ = size;
  n_used_ = 0;
  constexpr int kSmallest = 2 * kOrbBorderPx + 1;
  for (std::size_t i = 0; i < scales_.size(); ++i) {
    const int width = cvRound(static_cast<float>(size.width) / scales_[i]);
    const int height = cvRound(static_cast<float>(size.height) / scales_[i]);
    if (width < kSmallest || height < kSmallest) break;
    const auto step = static_cast<std::size_t>((width + 2 * kPaddingPx - 1) / kPaddingPx * kPaddingPx);
    memory_[i].assign(step * static_cast<std::size_t>(height), 0);
    levels_[i] = cv::Mat(height, width, CV_8UC1, memory_[i].data(), step);
    ++n_used_;
  }
}

}  // namespace cpslam
