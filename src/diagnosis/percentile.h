#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cpslam::diagnosis {

/// The value below which `share` (in [0, 1]) of at least one value lies; takes a copy to reorder.
template <typename Value>
[[nodiscard]] double percentile(std::vector<Value> values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return static_cast<double>(values[static_cast<std::size_t>(rank)]);
}

}  // namespace cpslam::diagnosis
