#include "detect/background_planes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

namespace cpslam {
namespace {

constexpr int kRingCells = 8;
constexpr int kMaxCells = 250;
constexpr std::size_t kMaxPlanes = 4;
constexpr int kHypotheses = 16;
// Cells between the draws of a hypothesis: a small plane is rarely hit thrice otherwise.
constexpr int kDrawReach = 6;
constexpr std::size_t kMinInliers = 15;
constexpr double kMinShare = 0.06;  // of the ring

/// (column, row, 1) and depth of a cell.
struct RingCell {
  Eigen::Vector3f at;
  float depth_m;
  float tolerance_m;
};

RingCell ring_cell(int x, int y, float depth_m) {
  return {{static_cast<float>(x), static_cast<float>(y), 1.0F}, depth_m, GridPlane::tolerance_m(depth_m)};
}

std::vector<RingCell> cells_around(const cv::Mat1f& depth_m, const cv::Rect& box) {
  const cv::Rect ring = cv::Rect(box.x - kRingCells, box.y - kRingCells, box.width + 2 * kRingCells,
                                 box.height + 2 * kRingCells) &
                        cv::Rect({}, depth_m.size());
  const int n_cells = std::max(1, ring.area() - box.area());
  const int step = std::max(1, static_cast<int>(std::sqrt(n_cells / double{kMaxCells})));
  std::vector<RingCell> cells;
  for (int y = ring.y; y < ring.br().y; y += step) {
    for (int x = ring.x; x < ring.br().x; x += step) {
      if (box.contains({x, y}) || depth_m(y, x) <= 0.0F) continue;
      cells.push_back(ring_cell(x, y, depth_m(y, x)));
    }
  }
  return cells;
}

GridPlane make_plane(const Eigen::Vector3f& p) {
  return {p.x(), p.y(), p.z()};
}

bool on_plane(const GridPlane& plane, const RingCell& cell) {
  const float inverse = plane.per_column * cell.at.x() + plane.per_row * cell.at.y() + plane.constant;
  return inverse > 0.0F && std::abs(cell.depth_m - 1.0F / inverse) < cell.tolerance_m;
}

std::optional<GridPlane> through(const RingCell& a, const RingCell& b, const RingCell& c) {
  Eigen::Matrix3f m;
  m << a.at.transpose(), b.at.transpose(), c.at.transpose();
  constexpr float kLeastArea = 8.0F;  // cells^2: flatter triangles say nothing across
  if (std::abs(m.determinant()) < kLeastArea) return std::nullopt;
  return make_plane(m.inverse() * Eigen::Vector3f(1.0F / a.depth_m, 1.0F / b.depth_m, 1.0F / c.depth_m));
}

GridPlane refit(const GridPlane& plane, const std::vector<RingCell>& cells) {
  Eigen::Matrix3f normal = Eigen::Matrix3f::Identity() * 1e-6F;
  Eigen::Vector3f right = Eigen::Vector3f::Zero();
  for (const RingCell& cell : cells) {
    if (!on_plane(plane, cell)) continue;
    normal += cell.at * cell.at.transpose();
    right += cell.at / cell.depth_m;
  }
  return make_plane(normal.ldlt().solve(right));
}

/// Draws planes from the cells around a box.
class PlaneFinder {
 public:
  PlaneFinder(const cv::Mat1f& depth_m, const cv::Rect& box, Random& random)
      : depth_m_(depth_m), box_(box), random_(random) {}

  [[nodiscard]] std::optional<GridPlane> find(const std::vector<RingCell>& cells, std::size_t min_inliers) {
    if (cells.size() < min_inliers) return std::nullopt;
    std::optional<GridPlane> best;
    std::size_t best_inliers = min_inliers - 1;
    for (int k = 0; k < kHypotheses; ++k) {
      const RingCell& a = cells[random_.index(cells.size())];
      const std::optional<RingCell> b = draw_near(a);
      const std::optional<RingCell> c = draw_near(a);
      const std::optional<GridPlane> plane = b && c ? through(a, *b, *c) : std::nullopt;
      if (!plane) continue;
      const GridPlane refitted = refit(*plane, cells);
      const std::size_t inliers = count_on(refitted, cells);
      if (inliers <= best_inliers) continue;
      best_inliers = inliers;
      best = refitted;
    }
    return best ? std::optional(refit(*best, cells)) : std::nullopt;
  }

 private:
  static std::size_t count_on(const GridPlane& plane, const std::vector<RingCell>& cells) {
    return static_cast<std::size_t>(std::count_if(
        cells.begin(), cells.end(), [&](const RingCell& cell) { return on_plane(plane, cell); }));
  }
  std::optional<RingCell> draw_near(const RingCell& cell) {
    const auto offset = [this] { return static_cast<int>(random_.index(2 * kDrawReach + 1)) - kDrawReach; };
    const int dx = offset();
    const cv::Point at(static_cast<int>(cell.at.x()) + dx, static_cast<int>(cell.at.y()) + offset());
    if (!cv::Rect({}, depth_m_.size()).contains(at) || box_.contains(at) || depth_m_(at) <= 0.0F)
      return std::nullopt;
    return ring_cell(at.x, at.y, depth_m_(at));
  }

  const cv::Mat1f& depth_m_;
  const cv::Rect box_;
  Random& random_;
};

}  // namespace

std::vector<GridPlane> find_background_planes(const cv::Mat1f& depth_m, const cv::Rect& box_cells,
                                              Random& random) {
  std::vector<RingCell> cells = cells_around(depth_m, box_cells);
  const auto min_inliers =
      std::max(kMinInliers, static_cast<std::size_t>(kMinShare * static_cast<double>(cells.size())));
  std::vector<GridPlane> planes;
  PlaneFinder finder(depth_m, box_cells, random);
  while (planes.size() < kMaxPlanes) {
    const std::optional<GridPlane> plane = finder.find(cells, min_inliers);
    if (!plane) break;
    planes.push_back(*plane);
    std::erase_if(cells, [&](const RingCell& cell) { return on_plane(*plane, cell); });
  }
  return planes;
}

}  // namespace cpslam
