#include "features/fast_score.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace cpslam {
namespace {

using Byte = std::uint8_t;

CPSLAM_KERNEL Byte smaller(Byte a, Byte b) {
  return a < b ? a : b;
}
CPSLAM_KERNEL Byte larger(Byte a, Byte b) {
  return a > b ? a : b;
}
CPSLAM_KERNEL Byte difference_or_zero(Byte a, Byte b) {
  return static_cast<Byte>(larger(a, b) - b);
}

/// Offsets of the 16 pixels of the circle of radius 3, clockwise from the top.
struct Circle {
  explicit Circle(std::ptrdiff_t step)
      : at{-3 * step, -3 * step + 1, -2 * step + 2, -step + 3, 3,  step + 3,  2 * step + 2,  3 * step + 1,
           3 * step,  3 * step - 1,  2 * step - 2,  step - 3,  -3, -step - 3, -2 * step - 2, -3 * step - 1} {}
  std::array<std::ptrdiff_t, 16> at;
};

/// Could any pixel of the block be a corner? Every arc of 9 holds two neighbours of the four compass points.
CPSLAM_KERNEL bool block_may_have_corner(const Byte* row, const Circle& circle, Byte threshold) {
  Byte any = 0;
  for (int j = 0; j < kFastBlock; ++j) {
    const Byte n = row[circle.at[0] + j];
    const Byte e = row[circle.at[4] + j];
    const Byte s = row[circle.at[8] + j];
    const Byte w = row[circle.at[12] + j];
    // Neighbouring compass points: one of n, s and one of e, w.
    const Byte bright = smaller(larger(n, s), larger(e, w));
    const Byte dark = larger(smaller(n, s), smaller(e, w));
    const Byte contrast = larger(difference_or_zero(bright, row[j]), difference_or_zero(row[j], dark));
    any = larger(any, contrast);
  }
  return any > threshold;
}

CPSLAM_KERNEL void block_contrast(const Byte* row, const Circle& circle, Byte* __restrict contrast) {
  for (int j = 0; j < kFastBlock; ++j) {
    std::array<Byte, 16> p;
    for (std::size_t i = 0; i < 16; ++i) p[i] = row[circle.at[i] + j];
    // The arcs of 9 that start at i - 1 and at i share the 8 pixels from i on, so eight shared arcs do for
    // all 16.
    std::array<Byte, 8> low2, high2, low4, high4;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t i = 2 * k + 1;
      low2[k] = smaller(p[i], p[(i + 1) % 16]);
      high2[k] = larger(p[i], p[(i + 1) % 16]);
    }
    for (std::size_t k = 0; k < 8; ++k) {
      low4[k] = smaller(low2[k], low2[(k + 1) % 8]);
      high4[k] = larger(high2[k], high2[(k + 1) % 8]);
    }
    Byte bright = 0;  // the best arc's darkest pixel
    Byte dark = 255;  // the best arc's brightest pixel
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t i = 2 * k + 1;
      const Byte low8 = smaller(low4[k], low4[(k + 2) % 8]);
      const Byte high8 = larger(high4[k], high4[(k + 2) % 8]);
      const Byte before = p[i - 1];
      const Byte after = p[(i + 8) % 16];
      bright = larger(bright, smaller(low8, larger(before, after)));
      dark = smaller(dark, larger(high8, smaller(before, after)));
    }
    contrast[j] = larger(difference_or_zero(bright, row[j]), difference_or_zero(row[j], dark));
  }
}

CPSLAM_KERNEL void contrast_row(const Byte* row, std::ptrdiff_t step, int count, Byte threshold,
                                Byte* contrast) {
  const Circle circle(step);
  for (int x = 0; x < count; x += kFastBlock) {
    if (block_may_have_corner(row + x, circle, threshold)) {
      block_contrast(row + x, circle, contrast + x);
    } else {
      std::memset(contrast + x, 0, kFastBlock);
    }
  }
}

CPSLAM_KERNEL void suppress_row(const Byte* above, const Byte* middle, const Byte* below, int count,
                                Byte threshold, Byte* __restrict kept) {
  for (int x = 0; x < count; x += kFastBlock) {
    for (int i = x; i < x + kFastBlock; ++i) {
      const Byte top = larger(larger(above[i - 1], above[i]), above[i + 1]);
      const Byte bottom = larger(larger(below[i - 1], below[i]), below[i + 1]);
      const Byte sides = larger(larger(middle[i - 1], middle[i + 1]), threshold);
      const Byte rival = larger(larger(top, bottom), sides);
      kept[i] = middle[i] > rival ? middle[i] : Byte{0};
    }
  }
}

CPSLAM_TARGET_AVX2 void contrast_row_avx2(const Byte* row, std::ptrdiff_t step, int count, Byte threshold,
                                          Byte* contrast) {
  contrast_row(row, step, count, threshold, contrast);
}
CPSLAM_TARGET_AVX2 void suppress_row_avx2(const Byte* above, const Byte* middle, const Byte* below, int count,
                                          Byte threshold, Byte* kept) {
  suppress_row(above, middle, below, count, threshold, kept);
}

}  // namespace

void fast_contrast_row(const Byte* row, std::ptrdiff_t step, int count, int threshold, Byte* contrast,
                       Simd simd) {
  const auto t = static_cast<Byte>(std::clamp(threshold, 0, 255));
  if (simd == Simd::kAvx2) return contrast_row_avx2(row, step, count, t, contrast);
  contrast_row(row, step, count, t, contrast);
}

void suppress_non_maxima_row(const Byte* above, const Byte* middle, const Byte* below, int count,
                             int threshold, Byte* kept, Simd simd) {
  const auto t = static_cast<Byte>(std::clamp(threshold, 0, 255));
  if (simd == Simd::kAvx2) return suppress_row_avx2(above, middle, below, count, t, kept);
  suppress_row(above, middle, below, count, t, kept);
}

}  // namespace cpslam
