#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>

#include "features/descriptor.h"
#include "features/orb_pattern.h"
#include "features/simd.h"

namespace cpslam {

/// Steered BRIEF (Rublee et al. 2011): the test pattern is turned by the keypoint's angle, its points rounded
/// to the nearest pixel (halves to even), and bit i is set where point 0 of pair i is darker than point 1.
/// Immutable.
class OrbDescriber {
 public:
  explicit OrbDescriber(Simd simd = best_simd());
  /// blurred: a pyramid level after GaussianBlur; (x, y) at least kOrbBorderPx from its border.
  [[nodiscard]] Descriptor describe(const cv::Mat& blurred, int x, int y, float angle_deg) const;

 private:
  static constexpr std::size_t kPoints = 2 * kPatternPairs;
  Simd simd_;
  // First points of all pairs, then second points.
  std::array<float, kPoints> x_, y_;
};

}  // namespace cpslam
