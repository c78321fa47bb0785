#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace cpslam {

/// Pairs the stamps of two lists: one-to-one, closest pairs first (of equally close ones the earlier in
/// `first`, then in `second`), |difference| < max_difference_s as in the TUM benchmark. Returns index pairs
/// in the order of time of `first`. The lists need no order; stamps that are not finite get no partner.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> associate_stamps(
    std::span<const double> first, std::span<const double> second, double max_difference_s);

}  // namespace cpslam
