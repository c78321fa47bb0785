#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cpslam {

/// The median (of an even number of values the upper one) of at least one value; reorders them.
template <typename Value>
[[nodiscard]] Value median(std::vector<Value>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace cpslam
