#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "features/corner.h"

namespace cpslam {

/// Two FAST thresholds over cells of about 30 px: a cell in which nothing reaches the first one gives all its
/// corners (Mur-Artal et al. 2015), so poor texture still yields some. Which corners take part is the
/// caller's choice: corners on people must not make a cell look rich for the wall behind them.
class CornerCells {
 public:
  explicit CornerCells(int first_threshold) : first_threshold_(first_threshold) {}

  /// Cuts a pyramid level into cells; the border that holds no corners is left out.
  void set_level(cv::Size level_size);

  /// kept: the corners that reach the first threshold and those of cells where none does; weak, unless null:
  /// the others. Both in the order given. Corners keep kOrbBorderPx from the border.
  void select(std::span<const Corner> corners, std::vector<Corner>& kept, std::vector<Corner>* weak);

 private:
  [[nodiscard]] std::uint8_t& is_strong(const Corner& c) {
    return is_strong_[static_cast<std::size_t>(row_[static_cast<std::size_t>(c.y)] * cells_per_row_ +
                                               column_[static_cast<std::size_t>(c.x)])];
  }

  int first_threshold_;
  int cells_per_row_ = 0;
  std::vector<int> column_, row_;        // of a pixel column, row
  std::vector<std::uint8_t> is_strong_;  // of a cell: something reaches the first threshold
};

}  // namespace cpslam
