#include "detect/moving_blobs.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "detect/grid_cells.h"

namespace cpslam {
namespace {

constexpr std::size_t kMinCells = 40;  // 640 px
constexpr int kReachCells = 8;         // of a part from what has arrived

/// The blob around a seed: arrived cells that hang together, and what hangs on them. Marks them as taken.
GridSurface flood(const cv::Mat1f& depth_m, int seed, cv::Mat1b& recent) {
  GridSurface blob;
  std::vector<int> reach{kReachCells};  // parallel to the blob's cells: how much further the flood may go
  blob.add(seed, depth_m(seed));
  recent(seed) = 0;
  for (std::size_t i = 0; i < blob.size(); ++i) {
    if (reach[i] == 0) continue;
    const cv::Point at(blob.cells[i] % depth_m.cols, blob.cells[i] / depth_m.cols);
    for (const cv::Point& next : neighbours(at)) {
      if (!cv::Rect({}, depth_m.size()).contains(next) || recent(next) == 0) continue;
      const float fold_m = recent(next) == 2 ? kFoldM : 0.0F;
      if (std::abs(depth_m(next) - depth_m(at)) > connected_step_m(depth_m(at)) + fold_m) continue;
      reach.push_back(recent(next) == 2 ? kReachCells : reach[i] - 1);
      recent(next) = 0;
      blob.add(next.y * depth_m.cols + next.x, depth_m(next));
    }
  }
  return blob;
}

}  // namespace

std::vector<GridSurface> find_moving_blobs(const cv::Mat1f& depth_m, const cv::Mat1b& still_age,
                                           const cv::Mat1b& people, int rim_cells) {
  // 2: has arrived; 1: may be a part of it, 0: taken or none of it
  cv::Mat1b recent(depth_m.size(), std::uint8_t{0});
  const auto n_cells = static_cast<int>(depth_m.total());
  for (int cell = 0; cell < n_cells; ++cell) {
    if (depth_m(cell) <= 0.0F || people(cell) != 0 || still_age(cell) > StillSurface::kRecentAge) continue;
    recent(cell) = still_age(cell) < StillSurface::kUnknownAge ? 2 : 1;
  }
  cv::Mat1b cores;
  cv::erode(recent == 2, cores, cv::Mat(), {-1, -1}, rim_cells);
  std::vector<GridSurface> blobs;
  for (int seed = 0; seed < n_cells; ++seed) {
    if (cores(seed) == 0 || recent(seed) == 0) continue;
    GridSurface blob = flood(depth_m, seed, recent);
    if (blob.size() >= kMinCells) blobs.push_back(std::move(blob));
  }
  return blobs;
}

}  // namespace cpslam
