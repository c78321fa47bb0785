#pragma once

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "detect/depth_grid.h"

namespace cpslam {

/// Middle of a column or row of cells, px of the image.
[[nodiscard]] inline float middle_px(int cell) {
  return (static_cast<float>(cell) + 0.5F) * static_cast<float>(kDepthCellPx) - 0.5F;
}

/// The cells to the right, left, below and above; they may lie outside the grid.
[[nodiscard]] inline std::array<cv::Point, 4> neighbours(cv::Point cell) {
  return {cell + cv::Point(1, 0), cell - cv::Point(1, 0), cell + cv::Point(0, 1), cell - cv::Point(0, 1)};
}

/// How far two neighbouring cells of one surface may differ in depth (m).
[[nodiscard]] inline float connected_step_m(float depth_m) {
  return 0.03F + 0.015F * depth_m;
}

/// How much more where something has arrived: folds of clothes, and between limbs (m).
inline constexpr float kFoldM = 0.05F;

/// Share of the cells that pass a test; 0 of none.
template <typename Test>
[[nodiscard]] float share_of(const std::vector<int>& cells, const Test& test) {
  const auto n = std::count_if(cells.begin(), cells.end(), test);
  return static_cast<float>(n) / static_cast<float>(std::max<std::size_t>(1, cells.size()));
}

}  // namespace cpslam
