#include "io/association.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cpslam {
namespace {

/// Indices of the finite stamps in the order of time.
std::vector<std::size_t> order_by_time(std::span<const double> stamps) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    if (std::isfinite(stamps[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return stamps[a] < stamps[b]; });
  return order;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> associate_stamps(std::span<const double> first,
                                                                  std::span<const double> second,
                                                                  double max_difference_s) {
  const std::vector<std::size_t> order_first = order_by_time(first);
  const std::vector<std::size_t> order_second = order_by_time(second);
  struct Candidate {
    double difference_s;
    std::size_t i, j;  // ranks in time
  };
  std::vector<Candidate> candidates;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < order_first.size(); ++i) {
    const double stamp = first[order_first[i]];
    const auto difference = [&](std::size_t j) { return second[order_second[j]] - stamp; };
    while (begin < order_second.size() && difference(begin) <= -max_difference_s) ++begin;
    for (std::size_t j = begin; j < order_second.size() && difference(j) < max_difference_s; ++j) {
      candidates.push_back({std::abs(difference(j)), i, j});
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.difference_s, a.i, a.j) < std::tie(b.difference_s, b.i, b.j);
  });
  constexpr std::size_t kFree = static_cast<std::size_t>(-1);
  std::vector<std::size_t> partner(order_first.size(), kFree);
  std::vector<bool> taken(order_second.size(), false);
  for (const Candidate& c : candidates) {
    if (partner[c.i] != kFree || taken[c.j]) continue;
    partner[c.i] = c.j;
    taken[c.j] = true;
  }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < partner.size(); ++i) {
    if (partner[i] != kFree) pairs.emplace_back(order_first[i], order_second[partner[i]]);
  }
  return pairs;
}

}  // namespace cpslam
