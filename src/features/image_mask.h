#pragma once

#include <algorithm>
#include <opencv2/core.hpp>

namespace cpslam {

/// Side (px of the image) of a coarse mask's cell.
inline constexpr int kMaskCellShift = 2;
inline constexpr int kMaskCellPx = 1 << kMaskCellShift;

/// Marked pixels of an image, looked up by pixel position. Shares the mask's memory.
class ImageMask {
 public:
  /// mask: CV_8UC1, non-zero marks; of the image's size, or one value per cell of 4 x 4 px (size / 4, rounded
  /// down: what is left over to the right and below belongs to the last cell), or empty: marks nothing.
  /// Throws InputError on another type or size.
  ImageMask(const cv::Mat& mask, cv::Size image_size);

  /// Nothing is marked.
  [[nodiscard]] bool empty() const { return mask_.empty(); }

  /// Not for empty masks. (x, y) inside the image, px; the pixel whose centre is nearest counts.
  [[nodiscard]] bool covers(float x, float y) const {
    const int column = std::min(cvRound(x) >> cell_shift_, mask_.cols - 1);
    const int row = std::min(cvRound(y) >> cell_shift_, mask_.rows - 1);
    return mask_.ptr(row)[column] != 0;
  }

 private:
  cv::Mat mask_;
  int cell_shift_ = 0;
};

}  // namespace cpslam
