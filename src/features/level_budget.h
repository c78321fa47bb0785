#pragma once

#include <span>
#include <vector>

#include "cpslam/settings.h"

namespace cpslam {

/// Shares n features out over the pyramid's levels in proportion to 1 / scale_factor^level; the last level
/// gets what the rounding leaves.
[[nodiscard]] std::vector<int> share_over_levels(int n, const OrbSettings& settings);

/// The same total as `wanted` as far as it is to be had: no level takes more than is `available` there, and
/// what one lacks goes to those with corners left, in proportion to `wanted`. Of equal length.
[[nodiscard]] std::vector<int> fit_to_available(std::span<const int> wanted, std::span<const int> available);

}  // namespace cpslam
