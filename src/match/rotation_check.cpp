#include "match/rotation_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace cpslam {

std::vector<bool> agrees_with_majority(std::span<const float> angle_differences_deg) {
  constexpr std::size_t kBins = 30;
  const auto bin_of = [](float difference_deg) {
    const float turns = difference_deg / 360.0F;
    const auto bin = static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<float>(kBins));
    return std::min(bin, kBins - 1);
  };
  std::array<int, kBins> histogram{};
  for (const float difference : angle_differences_deg) ++histogram[bin_of(difference)];
  std::array<std::size_t, kBins> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return histogram[a] > histogram[b]; });
  std::array<bool, kBins> accepted{};
  for (std::size_t i = 0; i < 3; ++i) accepted[order[i]] = histogram[order[i]] * 10 >= histogram[order[0]];
  std::vector<bool> agrees;
  agrees.reserve(angle_differences_deg.size());
  for (const float difference : angle_differences_deg) agrees.push_back(accepted[bin_of(difference)]);
  return agrees;
}

}  // namespace cpslam
