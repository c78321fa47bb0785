#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "features/corner.h"
#include "features/simd.h"

namespace cpslam {

/// FAST-9/16 corners of a pyramid level: the contrast of every pixel is computed once for the whole level and
/// serves every threshold from the given one on; per-cell FAST calls would cost several times as much.
/// Corners are local maxima among their eight neighbours (strict, as in cv::FAST).
class CornerDetector {
 public:
  explicit CornerDetector(int threshold, Simd simd = best_simd());

  /// Corners at least kOrbBorderPx from the border, in raster order. Rows of `level` must be padded as
  /// ImagePyramid's are, and the level at least 2 * kOrbBorderPx + 1 px wide and high.
  void detect(const cv::Mat& level, std::vector<Corner>& corners);

 private:
  void prepare(int level_width);
  void collect_row(int y, std::vector<Corner>& corners);

  int threshold_;
  Simd simd_;
  // Contrast rows start at the column one before the first corner, kMargin elements into the buffer.
  std::vector<std::uint8_t> contrast_[3], kept_;
  std::vector<std::size_t> busy_words_;  // positions in kept_
};

}  // namespace cpslam
