#include "features/descriptor.h"

#include "features/simd.h"

namespace cpslam {
namespace {

CPSLAM_TARGET_POPCNT void distances_by_popcnt(const Descriptor& query, std::span<const Descriptor> candidates,
                                              std::span<const int> indices, std::span<int> distances) {
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const Descriptor& candidate = candidates[static_cast<std::size_t>(indices[i])];
    int bits = 0;
    for (std::size_t w = 0; w < 4; ++w) bits += std::popcount(query.words[w] ^ candidate.words[w]);
    distances[i] = bits;
  }
}

}  // namespace

void descriptor_distances(const Descriptor& query, std::span<const Descriptor> candidates,
                          std::span<const int> indices, std::span<int> distances) {
  if (cpu_has_popcnt()) return distances_by_popcnt(query, candidates, indices, distances);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    distances[i] = descriptor_distance(query, candidates[static_cast<std::size_t>(indices[i])]);
  }
}

}  // namespace cpslam
