#include "place/k_medians.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "place/small_tree.h"

namespace cpslam {
namespace {

std::span<const Descriptor> members(const Clusters& clusters, std::size_t c,
                                    std::span<const Descriptor> descriptors) {
  return descriptors.subspan(clusters.starts[c], clusters.starts[c + 1] - clusters.starts[c]);
}

TEST(KMedians, FindsWellSeparatedClusters) {
  Random random(2);
  std::vector<Descriptor> looks;
  std::vector<Descriptor> descriptors;
  for (int i = 0; i < 6; ++i) looks.push_back(synthetic::random_descriptor(random));
  for (int n = 0; n < 40; ++n) {
    for (const Descriptor& look : looks)
      descriptors.push_back(synthetic::flipped(look, 5, static_cast<int>(random.index(251))));
  }
  const Clusters clusters = k_medians(descriptors, 6, 20, random);
  ASSERT_EQ(clusters.centres.size(), 6U);
  for (const Descriptor& look : looks)
    EXPECT_EQ(std::count(clusters.centres.begin(), clusters.centres.end(), look), 1)
        << "with 5 of 256 bits wrong, the median is the look itself";
}

TEST(KMedians, EveryDescriptorIsWithItsNearestCentre) {
  Random random(3);
  std::vector<Descriptor> descriptors = test::random_images(1, 500, 40, random).front();
  const std::vector<Descriptor> before = descriptors;
  const Clusters clusters = k_medians(descriptors, 10, 4, random);
  EXPECT_TRUE(std::is_permutation(descriptors.begin(), descriptors.end(), before.begin(), before.end()));
  ASSERT_EQ(clusters.starts.size(), clusters.centres.size() + 1);
  EXPECT_EQ(clusters.starts.front(), 0U);
  EXPECT_EQ(clusters.starts.back(), descriptors.size());
  for (std::size_t c = 0; c < clusters.centres.size(); ++c) {
    EXPECT_FALSE(members(clusters, c, descriptors).empty());
    for (const Descriptor& descriptor : members(clusters, c, descriptors)) {
      for (std::size_t other = 0; other < clusters.centres.size(); ++other) {
        const int own = descriptor_distance(descriptor, clusters.centres[c]);
        const int theirs = descriptor_distance(descriptor, clusters.centres[other]);
        EXPECT_TRUE(own < theirs || (own == theirs && c <= other));
      }
    }
  }
}

TEST(KMedians, FewerDifferentDescriptorsThanClusters) {
  Random random(4);
  std::vector<Descriptor> descriptors(30, test::bits(1));
  std::fill_n(descriptors.begin() + 5, 10, test::bits(0xF0));
  const Clusters clusters = k_medians(descriptors, 10, 5, random);
  ASSERT_EQ(clusters.centres.size(), 2U);
  EXPECT_EQ(members(clusters, 0, descriptors).size() + members(clusters, 1, descriptors).size(), 30U);

  std::vector<Descriptor> one{test::bits(3)};
  EXPECT_EQ(k_medians(one, 10, 5, random).centres.size(), 1U);
}

TEST(KMedians, IterationsLowerTheSumOfDistances) {
  const auto cost = [](int iterations) {
    Random random(6);
    std::vector<Descriptor> descriptors = test::random_images(1, 2000, 200, random).front();
    const Clusters clusters = k_medians(descriptors, 10, iterations, random);
    long sum = 0;
    for (std::size_t c = 0; c < clusters.centres.size(); ++c) {
      for (const Descriptor& descriptor : members(clusters, c, descriptors))
        sum += descriptor_distance(descriptor, clusters.centres[c]);
    }
    return sum;
  };
  EXPECT_LT(cost(1), cost(0));
  EXPECT_LT(cost(10), cost(1));
}

}  // namespace
}  // namespace cpslam
