#include "features/level_budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "util/random.h"

namespace cpslam {
namespace {

using Counts = std::vector<int>;

int sum(const Counts& counts) {
  return std::accumulate(counts.begin(), counts.end(), 0);
}

TEST(LevelBudget, FollowsTheAreaOfTheLevelsEdge) {
  EXPECT_EQ(share_over_levels(1000, {}), (Counts{217, 181, 151, 126, 105, 87, 73, 60}));
  EXPECT_EQ(share_over_levels(0, {}), Counts(8, 0));
  for (const int n : {1, 7, 150, 999}) EXPECT_EQ(sum(share_over_levels(n, {})), n);
}

TEST(LevelBudget, WhatALevelLacksGoesToTheOthersInProportion) {
  EXPECT_EQ(fit_to_available(Counts{40, 20, 10}, Counts{90, 90, 90}), (Counts{40, 20, 10}));
  // 10 are short and go 2 : 1.
  EXPECT_EQ(fit_to_available(Counts{40, 20, 15}, Counts{90, 90, 0}), (Counts{50, 25, 0}));
  // The first takes 5 of its 20 (of 30 short), the second the rest.
  EXPECT_EQ(fit_to_available(Counts{40, 20, 30}, Counts{45, 90, 0}), (Counts{45, 45, 0}));
  EXPECT_EQ(fit_to_available(Counts{40, 20, 30}, Counts{1, 2, 3}), (Counts{1, 2, 3}));
  EXPECT_EQ(fit_to_available(Counts{0, 0, 0}, Counts{1, 2, 3}), (Counts{0, 0, 0}));
}

TEST(LevelBudget, TakesAllThatIsWantedOrAllThereIs) {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Counts wanted = share_over_levels(1 + static_cast<int>(random.index(1200)), {});
    Counts available(wanted.size());
    for (int& n : available) n = static_cast<int>(random.index(400)) * static_cast<int>(random.index(2));
    const Counts taken = fit_to_available(wanted, available);
    int reachable = 0;  // a level that is wanted nothing of gives nothing
    for (std::size_t i = 0; i < taken.size(); ++i) {
      EXPECT_LE(taken[i], available[i]);
      EXPECT_GE(taken[i], std::min(wanted[i], available[i]));
      reachable += wanted[i] > 0 ? available[i] : 0;
    }
    EXPECT_EQ(sum(taken), std::min(sum(wanted), reachable));
  }
}

}  // namespace
}  // namespace cpslam
