#pragma once

#include <array>
#include <span>
#include <vector>

#include "features/keypoint.h"

namespace cpslam {

/// Keypoints sorted into cells of about 10 x 10 px, to find those near a place. Immutable once built.
class KeypointGrid {
 public:
  KeypointGrid() = default;
  /// bounds: min x, min y, max x, max y (px); keypoints outside go to the nearest border cell and are still
  /// found.
  KeypointGrid(std::span<const Keypoint> keypoints, const std::array<double, 4>& bounds);

  /// Appends to `out` the indices of the keypoints with |dx| <= radius and |dy| <= radius (a square window,
  /// px) and min_octave <= octave <= max_octave. Their order is fixed: cell by cell in raster order,
  /// ascending within a cell.
  void query(float x, float y, float radius, int min_octave, int max_octave, std::vector<int>& out) const;

 private:
  /// A copy of what a query tests, so that it reads memory in one stretch per row of cells.
  struct Entry {
    float x, y;
    int octave;
    int index;
  };
  [[nodiscard]] int column_of(float x) const;
  [[nodiscard]] int row_of(float y) const;

  float min_x_ = 0.0F, min_y_ = 0.0F;
  float cells_per_px_x_ = 0.0F, cells_per_px_y_ = 0.0F;
  int columns_ = 0, rows_ = 0;
  std::vector<int> cell_start_;  // of each cell in entries_, and the end
  std::vector<Entry> entries_;
};

}  // namespace cpslam
