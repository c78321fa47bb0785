#include "features/descriptor.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "util/random.h"

namespace cpslam {
namespace {

Descriptor random_descriptor(Random& random) {
  Descriptor d;
  for (auto& word : d.words) word = random.next();
  return d;
}

int distance_bit_by_bit(const Descriptor& a, const Descriptor& b) {
  int distance = 0;
  for (std::size_t i = 0; i < 256; ++i) {
    const std::uint64_t differ = (a.words[i / 64] ^ b.words[i / 64]) >> (i % 64);
    distance += static_cast<int>(differ & 1U);
  }
  return distance;
}

TEST(Descriptor, DistanceCountsEveryBit) {
  for (std::size_t i = 0; i < 256; ++i) {
    Descriptor d;
    d.words[i / 64] = std::uint64_t{1} << (i % 64);
    EXPECT_EQ(descriptor_distance(d, Descriptor{}), 1) << i;
    EXPECT_EQ(descriptor_distance(d, d), 0) << i;
  }
  Descriptor full;
  full.words.fill(~std::uint64_t{0});
  EXPECT_EQ(descriptor_distance(full, Descriptor{}), 256);
  EXPECT_EQ(detail::descriptor_distance_by_words(full, Descriptor{}), 256);
}

TEST(Descriptor, AllWaysOfCountingAgree) {
  Random random(1);
  std::vector<Descriptor> candidates;
  for (int i = 0; i < 500; ++i) candidates.push_back(random_descriptor(random));
  std::vector<int> indices(candidates.size());
  std::iota(indices.rbegin(), indices.rend(), 0);
  std::vector<int> distances(candidates.size());
  const Descriptor query = random_descriptor(random);
  descriptor_distances(query, candidates, indices, distances);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const Descriptor& candidate = candidates[static_cast<std::size_t>(indices[i])];
    const int expected = distance_bit_by_bit(query, candidate);
    EXPECT_EQ(distances[i], expected);
    EXPECT_EQ(descriptor_distance(query, candidate), expected);
    EXPECT_EQ(detail::descriptor_distance_by_words(query, candidate), expected);
#if defined(__SSE2__)
    EXPECT_EQ(detail::descriptor_distance_sse2(query, candidate), expected);
#endif
  }
}

}  // namespace
}  // namespace cpslam
