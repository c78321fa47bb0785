#include "util/time_budget.h"

#include <gtest/gtest.h>

namespace cpslam {
namespace {

TEST(TimeBudget, TheFirstTimeIsFree) {
  EXPECT_TRUE(TimeBudget(0.05).affordable());
}

TEST(TimeBudget, WhatWasSpentHasToBeEarnedBack) {
  TimeBudget budget(0.25);
  budget.spend(2.0);
  EXPECT_FALSE(budget.affordable());
  budget.earn(7.0);
  EXPECT_FALSE(budget.affordable()) << "1.75 of 2 ms are back";
  budget.earn(1.0);
  EXPECT_TRUE(budget.affordable());
}

TEST(TimeBudget, IdleTimeIsNotSavedUp) {
  TimeBudget budget(0.25);
  budget.earn(1e9);
  budget.spend(0.5);
  EXPECT_FALSE(budget.affordable());
}

TEST(TimeBudget, InTheLongRunTheShareIsKeptWhateverItCosts) {
  for (const double cost_ms : {0.1, 3.0, 80.0}) {
    TimeBudget budget(0.05);
    double spent_ms = 0.0;
    constexpr int kFrames = 10000;
    for (int i = 0; i < kFrames; ++i) {
      budget.earn(10.0);
      if (!budget.affordable()) continue;
      budget.spend(cost_ms);
      spent_ms += cost_ms;
    }
    EXPECT_LE(spent_ms, 0.05 * 10.0 * kFrames + cost_ms);
    // Not less than could be had: once a frame, or nearly the whole share.
    EXPECT_GE(spent_ms, cost_ms < 0.5 ? cost_ms * kFrames : 0.045 * 10.0 * kFrames);
  }
}

}  // namespace
}  // namespace cpslam
