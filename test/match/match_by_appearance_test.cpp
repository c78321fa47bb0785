#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "match/orb_matcher.h"
#include "support/synthetic.h"

namespace cpslam {
namespace {

using synthetic::flipped;
using synthetic::Spot;

std::vector<std::pair<int, int>> match(const FrameFeatures& a, const std::vector<int>& in_a,
                                       const FrameFeatures& b, const std::vector<int>& in_b,
                                       const MatchOptions& options) {
  std::vector<std::pair<int, int>> pairs;
  for (const KeypointMatch& m : match_by_appearance({a, in_a}, {b, in_b}, options))
    pairs.emplace_back(m.a, m.b);
  return pairs;
}

std::vector<int> all(const FrameFeatures& features) {
  std::vector<int> indices(static_cast<std::size_t>(features.size()));
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

std::shared_ptr<FrameFeatures> with_looks(const std::vector<Descriptor>& looks) {
  std::vector<Spot> spots;
  for (const Descriptor& look : looks) spots.push_back({.x = 100.0, .y = 100.0, .descriptor = look});
  return synthetic::make_features(spots);
}

using Pairs = std::vector<std::pair<int, int>>;

class MatchByAppearance : public testing::Test {
 protected:
  Random random{2};
  const Descriptor look = synthetic::random_descriptor(random);
  const Descriptor other = synthetic::random_descriptor(random);
};

TEST_F(MatchByAppearance, PairsMustBeEachOthersNearest) {
  // b's only one is nearer to a's second, so a's first goes without.
  const auto a = with_looks({flipped(look, 10), flipped(look, 4)});
  const auto b = with_looks({look});
  EXPECT_EQ(match(*a, all(*a), *b, all(*b), {}), (Pairs{{1, 0}}));
  EXPECT_EQ(match(*b, all(*b), *a, all(*a), {}), (Pairs{{0, 1}}));
}

TEST_F(MatchByAppearance, AmbiguousOnesAreRefusedByTheRatio) {
  const auto a = with_looks({look});
  const auto b = with_looks({flipped(look, 20), flipped(look, 24, 100)});
  MatchOptions options;
  EXPECT_EQ(match(*a, all(*a), *b, all(*b), options), (Pairs{{0, 0}}));
  options.ratio = 0.8F;
  EXPECT_TRUE(match(*a, all(*a), *b, all(*b), options).empty());
  options.ratio = 0.84F;
  EXPECT_EQ(match(*a, all(*a), *b, all(*b), options), (Pairs{{0, 0}}));
}

TEST_F(MatchByAppearance, RatioNeedsARival) {
  const auto a = with_looks({look});
  const auto b = with_looks({flipped(look, 40)});
  MatchOptions options;
  options.ratio = 0.5F;
  EXPECT_EQ(match(*a, all(*a), *b, all(*b), options), (Pairs{{0, 0}}));
  options.max_distance = 39;
  EXPECT_TRUE(match(*a, all(*a), *b, all(*b), options).empty());
}

TEST_F(MatchByAppearance, OnlyTheGivenKeypointsTakePart) {
  const auto a = with_looks({look, other, flipped(look, 3)});
  const auto b = with_looks({other, look, flipped(look, 3)});
  EXPECT_EQ(match(*a, {2, 1}, *b, {1, 0}, {}), (Pairs{{2, 1}, {1, 0}}));
  EXPECT_TRUE(match(*a, {}, *b, {0, 1}, {}).empty());
  EXPECT_TRUE(match(*a, {0}, *b, {}, {}).empty());
}

TEST_F(MatchByAppearance, FindsTwoViewsOfAWorldAndTheirTurn) {
  const synthetic::World world = synthetic::random_world(300, random);
  const synthetic::View a = synthetic::look(world, {}, {.bit_flips = 20}, random);
  const synthetic::View b =
      synthetic::look(world, synthetic::moved({}, {0.2, 0.1, 0.0}), {.bit_flips = 20}, random);
  FrameFeatures turned = *b.features;
  for (Keypoint& keypoint : turned.keypoints) keypoint.angle_deg = 340.0F;
  // One pair that looks alike but has turned the other way.
  const int odd = *std::find_if(b.keypoint_of.begin(), b.keypoint_of.end(), [](int k) { return k >= 0; });
  turned.keypoints[static_cast<std::size_t>(odd)].angle_deg = 90.0F;
  MatchOptions options;
  options.max_distance = kStrictDistance;
  options.ratio = 0.85F;
  const Pairs pairs = match(*a.features, all(*a.features), turned, all(turned), options);
  EXPECT_EQ(pairs.size(), static_cast<std::size_t>(turned.size()));
  for (const auto& [in_a, in_b] : pairs) {
    EXPECT_EQ(a.point_of[static_cast<std::size_t>(in_a)], b.point_of[static_cast<std::size_t>(in_b)]);
  }
  options.check_rotation = true;
  const Pairs checked = match(*a.features, all(*a.features), turned, all(turned), options);
  EXPECT_EQ(checked.size(), pairs.size() - 1);
  for (const auto& [in_a, in_b] : checked) EXPECT_NE(in_b, odd);
}

}  // namespace
}  // namespace cpslam
