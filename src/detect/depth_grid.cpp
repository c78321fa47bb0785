#include "detect/depth_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace cpslam {
namespace {

/// The second nearest of the valid readings, or the only one: a single near one may be a flying pixel.
float choose(std::array<float, 4>& readings, int n_valid) {
  if (n_valid == 0) return 0.0F;
  std::sort(readings.begin(), std::next(readings.begin(), n_valid));
  return readings[n_valid > 1 ? 1 : 0];
}

template <typename Unit>
void reduce(const cv::Mat& raw, float metres_per_unit, cv::Mat1f& grid) {
  constexpr int kFirst = kDepthCellPx / 4;
  constexpr int kSecond = kFirst + kDepthCellPx / 2;
  for (int y = 0; y < grid.rows; ++y) {
    const Unit* upper = raw.ptr<Unit>(y * kDepthCellPx + kFirst);
    const Unit* lower = raw.ptr<Unit>(y * kDepthCellPx + kSecond);
    for (int x = 0; x < grid.cols; ++x) {
      const int left = x * kDepthCellPx + kFirst;
      const int right = x * kDepthCellPx + kSecond;
      std::array<float, 4> valid{};
      int n = 0;
      for (const Unit unit : {upper[left], upper[right], lower[left], lower[right]}) {
        const float depth_m = static_cast<float>(unit) * metres_per_unit;
        if (depth_m > 0.0F && std::isfinite(depth_m)) valid.at(static_cast<std::size_t>(n++)) = depth_m;
      }
      grid(y, x) = choose(valid, n);
    }
  }
}

}  // namespace

cv::Mat1f reduce_depth(const cv::Mat& raw, double metres_per_unit) {
  cv::Mat1f grid(raw.rows / kDepthCellPx, raw.cols / kDepthCellPx);
  const auto scale = static_cast<float>(metres_per_unit);
  if (raw.type() == CV_32FC1) {
    reduce<float>(raw, scale, grid);
  } else {
    reduce<std::uint16_t>(raw, scale, grid);
  }
  return grid;
}

}  // namespace cpslam
