#include "features/corner_cells.h"

#include <algorithm>

#include "features/image_pyramid.h"

namespace cpslam {
namespace {

constexpr int kCellPx = 30;

/// Cell index of each of `size` pixels when [kOrbBorderPx, size - kOrbBorderPx) is cut into cells of about
/// kCellPx.
int number_cells(int size, std::vector<int>& cell_of_pixel) {
  const int inside = size - 2 * kOrbBorderPx;
  const int n_cells = std::max(1, inside / kCellPx);
  const int width = (inside + n_cells - 1) / n_cells;
  cell_of_pixel.assign(static_cast<std::size_t>(size), 0);
  for (int i = kOrbBorderPx; i < size; ++i) {
    cell_of_pixel[static_cast<std::size_t>(i)] = std::min((i - kOrbBorderPx) / width, n_cells - 1);
  }
  return n_cells;
}

}  // namespace

void CornerCells::set_level(cv::Size level_size) {
  cells_per_row_ = number_cells(level_size.width, column_);
  const int cell_rows = number_cells(level_size.height, row_);
  is_strong_.assign(static_cast<std::size_t>(cells_per_row_ * cell_rows), 0);
}

void CornerCells::select(std::span<const Corner> corners, std::vector<Corner>& kept,
                         std::vector<Corner>* weak) {
  std::fill(is_strong_.begin(), is_strong_.end(), std::uint8_t{0});
  for (const Corner& c : corners) is_strong(c) |= c.response >= first_threshold_ ? 1U : 0U;
  // Which corner is strong falls at random, so a branch on it would be mispredicted: write all, keep some.
  std::size_t n_kept = 0;
  kept.resize(corners.size());
  for (const Corner& c : corners) {
    kept[n_kept] = c;
    n_kept += c.response >= first_threshold_ || is_strong(c) == 0 ? 1U : 0U;
  }
  kept.resize(n_kept);
  if (weak == nullptr) return;
  std::size_t n_weak = 0;
  weak->resize(corners.size() - n_kept + 1);  // and one to write in vain
  for (const Corner& c : corners) {
    (*weak)[n_weak] = c;
    n_weak += c.response < first_threshold_ && is_strong(c) != 0 ? 1U : 0U;
  }
  weak->resize(n_weak);
}

}  // namespace cpslam
