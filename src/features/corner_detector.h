#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "features/corner.h"
#include "features/simd.h"

namespace cpslam {

/// FAST-9/16 corners of a pyramid level with two thresholds: cells of about 30 px in which nothing reaches
/// the first one give what reaches the second (Mur-Artal et al. 2015), so poor texture still yields corners.
/// The contrast of every pixel is computed once for the whole level and serves both thresholds; per-cell FAST
/// calls would cost several times as much. Corners are local maxima among their eight neighbours (strict, as
/// in cv::FAST).
class CornerDetector {
 public:
  CornerDetector(int first_threshold, int second_threshold, Simd simd = best_simd());

  /// Corners at least kOrbBorderPx from the border, in raster order. Rows of `level` must be padded as
  /// ImagePyramid's are, and the level at least 2 * kOrbBorderPx + 1 px wide and high.
  void detect(const cv::Mat& level, std::vector<Corner>& corners);

 private:
  void prepare(cv::Size level_size);
  void collect_row(int y, std::vector<Corner>& corners);
  void keep_by_cell(std::vector<Corner>& corners) const;

  int first_threshold_, second_threshold_;
  Simd simd_;
  // Contrast rows start at the column one before the first corner, kMargin elements into the buffer.
  std::vector<std::uint8_t> contrast_[3], kept_;
  std::vector<std::size_t> busy_words_;      // positions in kept_
  std::vector<int> cell_column_, cell_row_;  // of a pixel column, row
  int cells_per_row_ = 0;
  std::vector<std::uint8_t> cell_is_strong_;  // something reached the first threshold
};

}  // namespace cpslam
