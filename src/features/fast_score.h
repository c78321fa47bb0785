#pragma once

#include <cstddef>
#include <cstdint>

#include "features/simd.h"

namespace cpslam {

/// The kernels work on whole blocks of this many pixels: counts are rounded up, and the arrays must allow it.
inline constexpr int kFastBlock = 32;

/// FAST-9/16 contrast (Rosten and Drummond 2006) of `count` pixels of a row: the smallest difference to the
/// centre on the best arc of 9 of the 16 circle pixels, brighter or darker; 0 where there is none above
/// `threshold` in the block. A pixel is a corner at threshold t if and only if its contrast is greater than
/// t. Reads 3 px around.
void fast_contrast_row(const std::uint8_t* row, std::ptrdiff_t step, int count, int threshold,
                       std::uint8_t* contrast, Simd simd);

/// Keeps of the middle row what is greater than `threshold` and than all eight neighbours; the rest becomes
/// 0. Reads one element before and after.
void suppress_non_maxima_row(const std::uint8_t* above, const std::uint8_t* middle, const std::uint8_t* below,
                             int count, int threshold, std::uint8_t* kept, Simd simd);

}  // namespace cpslam
