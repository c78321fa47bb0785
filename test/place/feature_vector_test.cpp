#include "place/feature_vector.h"

#include <gmock/gmock.h>

#include <utility>

#include "util/random.h"

namespace cpslam {
namespace {

using testing::ElementsAre;

TEST(FeatureVector, GroupsFeaturesByNode) {
  const FeatureVector vector(std::vector<NodeId>{7, 3, 7, 3, 9, 7});
  ASSERT_EQ(vector.size(), 3U);
  EXPECT_EQ(vector.entry(0).node, 3U);
  EXPECT_THAT(vector.entry(0).features, ElementsAre(1, 3));
  EXPECT_EQ(vector.entry(1).node, 7U);
  EXPECT_THAT(vector.entry(1).features, ElementsAre(0, 2, 5));
  EXPECT_EQ(vector.entry(2).node, 9U);
  EXPECT_THAT(vector.entry(2).features, ElementsAre(4));
}

TEST(FeatureVector, WithoutFeatures) {
  EXPECT_EQ(FeatureVector().size(), 0U);
  EXPECT_EQ(FeatureVector(std::vector<NodeId>{}).size(), 0U);
  for_each_common_node(FeatureVector(), FeatureVector(std::vector<NodeId>{1}),
                       [](auto, auto) { ADD_FAILURE() << "there is no common node"; });
}

TEST(FeatureVector, CommonNodesGiveThePairsThatShareANode) {
  Random random(11);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<NodeId> nodes_a(random.index(60));
    std::vector<NodeId> nodes_b(random.index(60));
    for (NodeId& node : nodes_a) node = static_cast<NodeId>(random.index(20));
    for (NodeId& node : nodes_b) node = static_cast<NodeId>(random.index(20));
    std::vector<std::pair<int, int>> expected;
    for (std::size_t i = 0; i < nodes_a.size(); ++i) {
      for (std::size_t j = 0; j < nodes_b.size(); ++j) {
        if (nodes_a[i] == nodes_b[j]) expected.emplace_back(static_cast<int>(i), static_cast<int>(j));
      }
    }
    std::vector<std::pair<int, int>> found;
    for_each_common_node(FeatureVector(nodes_a), FeatureVector(nodes_b),
                         [&](std::span<const int> a, std::span<const int> b) {
                           for (const int i : a) {
                             for (const int j : b) found.emplace_back(i, j);
                           }
                         });
    EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected));
  }
}

}  // namespace
}  // namespace cpslam
