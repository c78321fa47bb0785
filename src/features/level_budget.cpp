#include "features/level_budget.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace cpslam {

std::vector<int> share_over_levels(int n, const OrbSettings& settings) {
  const double ratio = 1.0 / settings.scale_factor;
  double total = 0.0;
  for (int i = 0; i < settings.n_levels; ++i) total += std::pow(ratio, i);
  std::vector<int> wanted;
  int left = n;
  for (int i = 0; i < settings.n_levels; ++i) {
    const bool last = i + 1 == settings.n_levels;
    const int share = static_cast<int>(std::lround(n * std::pow(ratio, i) / total));
    wanted.push_back(last ? left : std::min(share, left));
    left -= wanted.back();
  }
  return wanted;
}

std::vector<int> fit_to_available(std::span<const int> wanted, std::span<const int> available) {
  std::vector<int> taken(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) taken[i] = std::min(wanted[i], available[i]);
  int left = std::reduce(wanted.begin(), wanted.end()) - std::reduce(taken.begin(), taken.end());
  // Every round gives out the whole rest or fills a level, so there are few.
  while (left > 0) {
    std::int64_t weight = 0;  // of the levels with corners left
    for (std::size_t i = 0; i < wanted.size(); ++i) weight += taken[i] < available[i] ? wanted[i] : 0;
    if (weight == 0) break;
    const std::int64_t rest = left;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const auto share = static_cast<int>((rest * wanted[i] + weight - 1) / weight);  // rounded up: ends
      const int more = std::min({share, available[i] - taken[i], left});
      taken[i] += more;
      left -= more;
    }
  }
  return taken;
}

}  // namespace cpslam
