#include "detect/still_surface.h"

#include <algorithm>
#include <cmath>

#include "camera/depth_noise.h"

namespace cpslam {
namespace {

constexpr int kOldest = 250;
constexpr float kArrivalM = 0.1F;  // before what was known
constexpr float kGain = 0.3F;      // of a reading on the running mean

std::uint8_t one_older(std::uint8_t age) {
  return static_cast<std::uint8_t>(std::min(kOldest, age + 1));
}

/// Age of a surface next to a cell that has long stood still and is where the reading says, 0 if there is
/// none: at an edge in depth the reading of a cell jumps from one side to the other.
std::uint8_t age_beside(const StillSurface& expected, cv::Point at, float read_m) {
  constexpr std::uint8_t kEstablished = 10;
  const cv::Rect around = cv::Rect(at.x - 1, at.y - 1, 3, 3) & cv::Rect({}, expected.free_age.size());
  for (int y = around.y; y < around.br().y; ++y) {
    for (int x = around.x; x < around.br().x; ++x) {
      const float known_m = expected.depth_m(y, x);
      if (known_m > 0.0F && expected.free_age(y, x) >= kEstablished &&
          std::abs(known_m - read_m) < still_tolerance_m(known_m))
        return expected.free_age(y, x);
    }
  }
  return 0;
}

StillSurface unknown(const cv::Mat1f& depth_m) {
  const cv::Mat1b age(depth_m.size(), StillSurface::kUnknownAge);
  return {depth_m, age, age.clone(), cv::Mat1b(depth_m.size(), std::uint8_t{0})};
}

}  // namespace

float still_tolerance_m(float depth_m) {
  return 0.02F + 4.0F * static_cast<float>(structured_light_sigma_m(static_cast<double>(depth_m)));
}

StillSurface StillSurface::begin(const cv::Mat1f& depth_m) {
  return unknown(depth_m);
}

void StillSurface::claim(const cv::Mat1b& people) {
  free_age.setTo(0, people);
}

StillSurface StillSurface::move(const GridCamera& camera, const SE3& next_from_this) const {
  const FloatTransform next_from(next_from_this);
  const cv::Size size = depth_m.size();
  StillSurface moved = unknown(cv::Mat1f(size, 0.0F));
  const float* from_m = depth_m[0];
  float* to_m = moved.depth_m[0];
  for (int cell = 0; cell < camera.n_cells(); ++cell) {
    if (from_m[cell] <= 0.0F) continue;
    const Eigen::Vector3f point = next_from * camera.point(cell, from_m[cell]);
    const int there = camera.cell_of(point);
    if (there < 0 || (to_m[there] > 0.0F && to_m[there] <= point.z())) continue;
    to_m[there] = point.z();
    moved.age[0][there] = age[0][cell];
    moved.free_age[0][there] = free_age[0][cell];
    moved.changed[0][there] = changed[0][cell];
  }
  return moved;
}

StillSurface StillSurface::carry(const GridCamera& camera, const cv::Mat1f& next_depth_m,
                                 const SE3& next_from_this) const {
  const StillSurface expected = move(camera, next_from_this);
  StillSurface next{expected.depth_m.clone(), expected.age.clone(), expected.free_age.clone(),
                    expected.changed.clone()};
  const float* expected_m = expected.depth_m[0];
  float* known_m = next.depth_m[0];
  std::uint8_t* next_age = next.age[0];
  std::uint8_t* next_free_age = next.free_age[0];
  for (int cell = 0; cell < camera.n_cells(); ++cell) {
    const float read_m = next_depth_m[0][cell];
    if (read_m <= 0.0F) continue;  // what was expected there may still be there
    const float nearer_m = expected_m[cell] - read_m;
    if (expected_m[cell] > 0.0F && std::abs(nearer_m) < still_tolerance_m(expected_m[cell])) {
      known_m[cell] -= kGain * nearer_m;
      next_age[cell] = one_older(next_age[cell]);
      next_free_age[cell] = one_older(next_free_age[cell]);
      continue;
    }
    const std::uint8_t beside = age_beside(expected, {cell % depth_m.cols, cell / depth_m.cols}, read_m);
    const bool arrived = expected_m[cell] > 0.0F && nearer_m > kArrivalM;
    next_age[cell] = beside > 0 ? beside : (arrived ? std::uint8_t{0} : kUnknownAge);
    next_free_age[cell] = next_age[cell];
    next.changed[0][cell] = beside == 0 && expected_m[cell] > 0.0F ? 1 : 0;
    known_m[cell] = read_m;
  }
  return next;
}

}  // namespace cpslam
