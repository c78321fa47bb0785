#include "features/orb_describer.h"

#include <cmath>
#include <numbers>

namespace cpslam {
namespace {

/// 1.5 * 2^23: adding and subtracting it rounds a small float to the nearest integer, halves to even; SSE2
/// has no other quick way.
constexpr float kRounder = 12582912.0F;

CPSLAM_KERNEL void rotate(const float* x, const float* y, float cosine, float sine, float step,
                          std::int32_t* __restrict offset) {
  constexpr int kPoints = 2 * kPatternPairs;
  for (int i = 0; i < kPoints; ++i) {
    const float turned_x = (x[i] * cosine - y[i] * sine + kRounder) - kRounder;
    const float turned_y = (x[i] * sine + y[i] * cosine + kRounder) - kRounder;
    offset[i] = static_cast<std::int32_t>(turned_y * step + turned_x);
  }
}

CPSLAM_TARGET_AVX2 void rotate_avx2(const float* x, const float* y, float cosine, float sine, float step,
                                    std::int32_t* offset) {
  rotate(x, y, cosine, sine, step, offset);
}

}  // namespace

OrbDescriber::OrbDescriber(Simd simd) : simd_(simd) {
  for (std::size_t i = 0; i < kPatternPairs; ++i) {
    const PatternPair& pair = kOrbPattern[i];
    x_[i] = pair.x0;
    y_[i] = pair.y0;
    x_[i + kPatternPairs] = pair.x1;
    y_[i + kPatternPairs] = pair.y1;
  }
}

Descriptor OrbDescriber::describe(const cv::Mat& blurred, int x, int y, float angle_deg) const {
  const float angle = angle_deg * (std::numbers::pi_v<float> / 180.0F);
  const float cosine = std::cos(angle);
  const float sine = std::sin(angle);
  const auto step = static_cast<float>(static_cast<std::size_t>(blurred.step));
  std::array<std::int32_t, kPoints> offset;
  if (simd_ == Simd::kAvx2) {
    rotate_avx2(x_.data(), y_.data(), cosine, sine, step, offset.data());
  } else {
    rotate(x_.data(), y_.data(), cosine, sine, step, offset.data());
  }
  const std::uint8_t* centre = blurred.ptr(y) + x;
  Descriptor descriptor;
  for (std::size_t word = 0; word < descriptor.words.size(); ++word) {
    std::uint64_t bits = 0;
    // From the last bit to the first, so that every test is pushed in from below.
    for (std::size_t i = 64 * (word + 1); i-- > 64 * word;) {
      bits = 2 * bits + (centre[offset[i]] < centre[offset[i + kPatternPairs]] ? 1U : 0U);
    }
    descriptor.words[word] = bits;
  }
  return descriptor;
}

}  // namespace cpslam
