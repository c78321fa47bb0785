#include <benchmark/benchmark.h>

#include <numeric>
#include <vector>

#include "features/descriptor.h"
#include "util/random.h"

namespace cpslam {
namespace {

constexpr std::size_t kCandidates = 1000;

std::vector<Descriptor> random_descriptors() {
  Random random(1);
  std::vector<Descriptor> descriptors(kCandidates);
  for (Descriptor& d : descriptors) {
    for (auto& word : d.words) word = random.next();
  }
  return descriptors;
}

template <typename Distance>
void run(benchmark::State& state, const Distance& distance) {
  const std::vector<Descriptor> descriptors = random_descriptors();
  for (auto _ : state) {
    int best = 256;
    for (std::size_t i = 1; i < kCandidates; ++i)
      best = std::min(best, distance(descriptors[0], descriptors[i]));
    benchmark::DoNotOptimize(best);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kCandidates - 1));
}

void DistanceByWords(benchmark::State& state) {
  run(state, detail::descriptor_distance_by_words);
}
BENCHMARK(DistanceByWords);

void Distance(benchmark::State& state) {
  run(state, [](const Descriptor& a, const Descriptor& b) { return descriptor_distance(a, b); });
}
BENCHMARK(Distance);

/// Argument: candidates per call.
void DistancesInBatch(benchmark::State& state) {
  const std::vector<Descriptor> descriptors = random_descriptors();
  std::vector<int> indices(static_cast<std::size_t>(state.range(0)));
  std::iota(indices.begin(), indices.end(), 1);
  std::vector<int> distances(indices.size());
  for (auto _ : state) {
    descriptor_distances(descriptors[0], descriptors, indices, distances);
    benchmark::DoNotOptimize(distances.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(DistancesInBatch)->Arg(10)->Arg(999);

}  // namespace
}  // namespace cpslam
