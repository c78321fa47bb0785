#include "features/keypoint_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cpslam {
namespace {

constexpr double kCellPx = 10.0;

/// Cell of a coordinate, clamped to the grid; safe for any float.
int clamped_cell(float offset_cells, int n_cells) {
  const float last = static_cast<float>(n_cells - 1);
  // The comparison is false for NaN, which goes to cell 0 and then fails every window test.
  return offset_cells > 0.0F ? static_cast<int>(std::min(offset_cells, last)) : 0;
}

}  // namespace

KeypointGrid::KeypointGrid(std::span<const Keypoint> keypoints, const std::array<double, 4>& bounds)
    : min_x_(static_cast<float>(bounds[0])), min_y_(static_cast<float>(bounds[1])) {
  const double width = std::max(bounds[2] - bounds[0], 1.0);
  const double height = std::max(bounds[3] - bounds[1], 1.0);
  columns_ = std::max(1, static_cast<int>(std::lround(width / kCellPx)));
  rows_ = std::max(1, static_cast<int>(std::lround(height / kCellPx)));
  cells_per_px_x_ = static_cast<float>(columns_ / width);
  cells_per_px_y_ = static_cast<float>(rows_ / height);

  const auto cell_of = [this](const Keypoint& k) {
    return static_cast<std::size_t>(row_of(k.y) * columns_ + column_of(k.x));
  };
  // Counting sort: count, sum up to the ends of the cells, fill from the back so that each end becomes the
  // start.
  cell_start_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const Keypoint& k : keypoints) ++cell_start_[cell_of(k)];
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  entries_.resize(keypoints.size());
  for (std::size_t i = keypoints.size(); i-- > 0;) {
    const Keypoint& k = keypoints[i];
    const int position = --cell_start_[cell_of(k)];
    entries_[static_cast<std::size_t>(position)] = {k.x, k.y, k.octave, static_cast<int>(i)};
  }
}

int KeypointGrid::column_of(float x) const {
  return clamped_cell((x - min_x_) * cells_per_px_x_, columns_);
}
int KeypointGrid::row_of(float y) const {
  return clamped_cell((y - min_y_) * cells_per_px_y_, rows_);
}

void KeypointGrid::query(float x, float y, float radius, int min_octave, int max_octave,
                         std::vector<int>& out) const {
  if (entries_.empty()) return;
  const int first_column = column_of(x - radius);
  const int last_column = column_of(x + radius);
  const int last_row = row_of(y + radius);
  for (int row = row_of(y - radius); row <= last_row; ++row) {
    // The cells of a row lie next to each other, so a row is one stretch of entries.
    const int begin = cell_start_[static_cast<std::size_t>(row * columns_ + first_column)];
    const int end = cell_start_[static_cast<std::size_t>(row * columns_ + last_column) + 1];
    for (int i = begin; i < end; ++i) {
      const Entry& e = entries_[static_cast<std::size_t>(i)];
      if (e.octave < min_octave || e.octave > max_octave) continue;
      if (std::abs(e.x - x) <= radius && std::abs(e.y - y) <= radius) out.push_back(e.index);
    }
  }
}

}  // namespace cpslam
