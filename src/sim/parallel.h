#pragma once

#include <atomic>
#include <thread>
#include <vector>

namespace cpslam::sim {

/// Runs work(item, thread) for every item in [0, n_items) on n_threads threads, the caller's among them. The
/// work must not throw.
template <typename Work>
void for_each_parallel(int n_items, int n_threads, const Work& work) {
  std::atomic<int> next{0};
  const auto loop = [&](int thread) {
    for (int item = next++; item < n_items; item = next++) work(item, thread);
  };
  std::vector<std::jthread> helpers;
  for (int thread = 1; thread < n_threads; ++thread) helpers.emplace_back(loop, thread);
  loop(0);
}

}  // namespace cpslam::sim
