#include "features/keypoint_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "camera/depth_noise.h"

namespace cpslam {
namespace {

constexpr int kReach = 2;
constexpr std::size_t kNeighbourhood = 25;
constexpr double kSlantSpread =
    0.05;  // of the depth: what a slanted surface may spread over the neighbourhood
constexpr double kNoiseSpread = 3.0;  // sensor sigmas on top
constexpr double kEdgeGap =
    0.4;  // of the spread: two surfaces leave a gap between them, a steep one does not
constexpr double kNearSupport = 0.2;  // of the readings
constexpr std::size_t kMinNear = 3;
constexpr std::size_t kMinWithoutCentre = 8;  // 30 % of the neighbourhood
constexpr double kInflation = 2.0;
constexpr double kHalfPixelOfSpread = 1.0 / 8.0;  // the neighbourhood spans four pixel steps

/// Valid readings around a pixel, m.
struct Neighbourhood {
  std::array<float, kNeighbourhood> depth_m;
  std::size_t count = 0;
  float centre_m = 0.0F;  // 0 where there is none

  [[nodiscard]] std::span<float> readings() { return {depth_m.data(), count}; }
};

template <typename Unit>
Neighbourhood look_around(const cv::Mat& raw, double metres_per_unit, int x, int y) {
  Neighbourhood n;
  for (int v = std::max(0, y - kReach); v <= std::min(raw.rows - 1, y + kReach); ++v) {
    const Unit* row = raw.ptr<Unit>(v);
    for (int u = std::max(0, x - kReach); u <= std::min(raw.cols - 1, x + kReach); ++u) {
      const auto depth_m = static_cast<float>(static_cast<double>(row[u]) * metres_per_unit);
      if (!(depth_m > 0.0F) || !std::isfinite(depth_m)) continue;
      n.depth_m[n.count++] = depth_m;
      if (u == x && v == y) n.centre_m = depth_m;
    }
  }
  return n;
}

/// Readings of one surface, ascending.
using Surface = std::span<const float>;

DepthReading reading_on(Surface surface, float depth_m, double inflation) {
  const double spread = static_cast<double>(surface.back()) - static_cast<double>(surface.front());
  const double sigma =
      std::hypot(structured_light_sigma_m(static_cast<double>(depth_m)), kHalfPixelOfSpread * spread);
  return {depth_m, static_cast<float>(inflation * sigma)};
}

DepthReading median_of(Surface surface) {
  return reading_on(surface, surface[surface.size() / 2], kInflation);
}

/// Number of readings before the widest gap; at least two readings.
std::size_t widest_gap(Surface sorted) {
  std::size_t before = 1;
  for (std::size_t i = 2; i < sorted.size(); ++i) {
    if (sorted[i] - sorted[i - 1] > sorted[before] - sorted[before - 1]) before = i;
  }
  return before;
}

/// The neighbourhood holds two surfaces: the first n_near readings and the rest.
DepthReading judge_edge(Surface all, std::size_t n_near, float centre_m) {
  const Surface near = all.first(n_near);
  const Surface far = all.subspan(n_near);
  const bool near_is_real =
      n_near >= kMinNear && static_cast<double>(n_near) >= kNearSupport * static_cast<double>(all.size());
  const Surface surface = near_is_real ? near : far;
  if (centre_m > 0.0F) return near_is_real ? median_of(near) : reading_on(far, centre_m, kInflation);
  return surface.size() >= kMinWithoutCentre ? median_of(surface) : DepthReading{};
}

DepthReading judge(Neighbourhood& n) {
  const bool has_centre = n.centre_m > 0.0F;
  if (!has_centre && n.count < kMinWithoutCentre) return {};
  const auto [nearest, farthest] = std::minmax_element(n.readings().begin(), n.readings().end());
  const double nearest_m = static_cast<double>(*nearest);
  const double spread = static_cast<double>(*farthest) - nearest_m;
  const bool one_surface =
      spread <= kSlantSpread * nearest_m + kNoiseSpread * structured_light_sigma_m(nearest_m);
  if (one_surface && has_centre) {  // nearly all keypoints: no need to sort
    const std::array<float, 2> ends{*nearest, *farthest};
    return reading_on(ends, n.centre_m, 1.0);
  }
  std::sort(n.readings().begin(), n.readings().end());
  const Surface all = n.readings();
  if (!one_surface) {
    const std::size_t n_near = widest_gap(all);
    const double gap = static_cast<double>(all[n_near]) - static_cast<double>(all[n_near - 1]);
    if (gap >= kEdgeGap * spread) return judge_edge(all, n_near, n.centre_m);
  }
  return has_centre ? reading_on(all, n.centre_m, 1.0) : median_of(all);
}

}  // namespace

DepthReading read_keypoint_depth(const cv::Mat& raw_depth, double metres_per_unit, int x, int y) {
  Neighbourhood n = raw_depth.type() == CV_32FC1
                        ? look_around<float>(raw_depth, metres_per_unit, x, y)
                        : look_around<std::uint16_t>(raw_depth, metres_per_unit, x, y);
  return judge(n);
}

}  // namespace cpslam
