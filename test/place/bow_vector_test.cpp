#include "place/bow_vector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "util/random.h"

namespace cpslam {
namespace {

BowVector random_bag(Random& random) {
  std::map<WordId, double> words;
  double sum = 0.0;
  const std::size_t n = random.index(40);
  for (std::size_t i = 0; i < n; ++i)
    sum += words[static_cast<WordId>(random.index(60))] = random.uniform(0.1, 1.0);
  sum = 0.0;
  for (const auto& [word, weight] : words) sum += weight;
  BowVector bag;
  for (const auto& [word, weight] : words) bag.push_back({word, static_cast<float>(weight / sum)});
  return bag;
}

TEST(BowVector, ScoreByHand) {
  const BowVector a{{1, 0.5F}, {4, 0.25F}, {7, 0.25F}};
  const BowVector b{{1, 0.25F}, {5, 0.25F}, {7, 0.5F}};
  EXPECT_DOUBLE_EQ(score(a, b), 0.5);
  EXPECT_DOUBLE_EQ(score(a, a), 1.0);
  EXPECT_DOUBLE_EQ(score(a, {{2, 1.0F}}), 0.0);
  EXPECT_DOUBLE_EQ(score(a, {}), 0.0);
}

TEST(BowVector, ScoreIsOneLessHalfTheL1Distance) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const BowVector a = random_bag(random);
    const BowVector b = random_bag(random);
    if (a.empty() || b.empty()) continue;
    std::map<WordId, double> difference;
    for (const WordWeight& word : a) difference[word.word] += static_cast<double>(word.weight);
    for (const WordWeight& word : b) difference[word.word] -= static_cast<double>(word.weight);
    double l1 = 0.0;
    for (const auto& [word, d] : difference) l1 += std::abs(d);
    EXPECT_NEAR(score(a, b), 1.0 - l1 / 2.0, 1e-6);
    EXPECT_DOUBLE_EQ(score(a, b), score(b, a));
  }
}

}  // namespace
}  // namespace cpslam
