#include "detect/depth_grid.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace cpslam {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

/// The second nearest of the readings that are there, or the only one: a single near one may be a flying
/// pixel. kNone where there is none.
float choose(float a, float b, float c, float d) {
  const float nearest = std::min(std::min(a, b), std::min(c, d));
  const float second =
      std::min(std::max(std::min(a, b), std::min(c, d)), std::min(std::max(a, b), std::max(c, d)));
  return second < kNone ? second : nearest;
}

template <typename Unit>
void reduce(const cv::Mat& raw, float metres_per_unit, cv::Mat1f& grid) {
  constexpr int kFirst = kDepthCellPx / 4;
  constexpr int kSecond = kFirst + kDepthCellPx / 2;
  const auto reading = [metres_per_unit](Unit unit) {
    const float depth_m = static_cast<float>(unit) * metres_per_unit;
    return depth_m > 0.0F ? depth_m : kNone;
  };
  for (int y = 0; y < grid.rows; ++y) {
    float* row = grid[y];
    const Unit* upper = raw.ptr<Unit>(y * kDepthCellPx + kFirst);
    const Unit* lower = raw.ptr<Unit>(y * kDepthCellPx + kSecond);
    for (int x = 0; x < grid.cols; ++x) {
      const int left = x * kDepthCellPx + kFirst;
      const int right = x * kDepthCellPx + kSecond;
      const float depth_m =
          choose(reading(upper[left]), reading(upper[right]), reading(lower[left]), reading(lower[right]));
      row[x] = depth_m < kNone ? depth_m : 0.0F;
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
