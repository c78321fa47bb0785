#include "detect/still_surface.h"

#include <algorithm>
#include <cmath>

#include "camera/depth_noise.h"

namespace cpslam {
namespace {

constexpr int kOldest = 250;
constexpr float kGain = 0.3F;  // of a reading on the running mean

}  // namespace

float still_tolerance_m(float depth_m) {
  return 0.02F + 4.0F * static_cast<float>(structured_light_sigma_m(static_cast<double>(depth_m)));
}

StillSurface StillSurface::begin(const cv::Mat1f& depth_m) {
  return {depth_m, cv::Mat1b(depth_m.size(), kUnknownAge)};
}

StillSurface StillSurface::carry(const GridCamera& camera, const cv::Mat1f& next_depth_m,
                                 const SE3& next_from_this) const {
  const FloatTransform move(next_from_this);
  StillSurface next{cv::Mat1f(depth_m.size(), 0.0F), cv::Mat1b(depth_m.size(), kUnknownAge)};
  for (int cell = 0; cell < camera.n_cells(); ++cell) {
    if (depth_m(cell) <= 0.0F) continue;
    const Eigen::Vector3f moved = move * camera.point(cell, depth_m(cell));
    const int there = camera.cell_of(moved);
    if (there < 0 || (next.depth_m(there) > 0.0F && next.depth_m(there) <= moved.z())) continue;
    next.depth_m(there) = moved.z();
    next.age(there) = age(cell);
  }
  for (int cell = 0; cell < camera.n_cells(); ++cell) {
    const float read_m = next_depth_m(cell);
    if (read_m <= 0.0F) continue;  // what was expected there may still be there
    float& known_m = next.depth_m(cell);
    const float nearer_m = known_m - read_m;
    if (known_m > 0.0F && std::abs(nearer_m) < still_tolerance_m(known_m)) {
      known_m -= kGain * nearer_m;
      next.age(cell) = static_cast<std::uint8_t>(std::min(kOldest, next.age(cell) + 1));
    } else {
      const bool arrived = known_m > 0.0F && nearer_m > 0.0F;
      next.age(cell) = arrived ? std::uint8_t{0} : kUnknownAge;
      known_m = read_m;
    }
  }
  return next;
}

}  // namespace cpslam
