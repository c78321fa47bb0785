#include "viewer/timing_history.h"

#include <gtest/gtest.h>

#include <numeric>

namespace cpslam::viewer {
namespace {

FrameSnapshot snapshot(std::uint64_t index, double track_ms, double features_ms, double people_ms,
                       double wait_ms) {
  FrameSnapshot frame;
  frame.index = index;
  const auto add = [&](const char* name, double total_ms) {
    StageTimes stage;
    stage.stage = name;
    stage.total_ms = total_ms;
    frame.stages.push_back(stage);
  };
  add("track", track_ms);
  add("track: features", features_ms);
  add("people: carry", 0.5 * people_ms);
  add("people: flow", 0.5 * people_ms);
  add("track: wait for boxes", wait_ms);
  add("map: fusion", 1000.0);
  return frame;
}

TEST(TimingHistory, PartsAddUpToTheWholeFrame) {
  TimingHistory history;
  history.add(snapshot(0, 10.0, 4.0, 2.0, 1.0));
  ASSERT_EQ(history.frames().size(), 1U);
  EXPECT_EQ(history.frames()[0], (TimingParts{4.0, 2.0, 1.0, 3.0}));
}

TEST(TimingHistory, DifferencesArePerFrameWhenFramesWereLeftOut) {
  TimingHistory history;
  history.add(snapshot(0, 10.0, 4.0, 2.0, 1.0));
  history.add(snapshot(4, 50.0, 24.0, 2.0, 1.0));
  ASSERT_EQ(history.frames().size(), 2U);
  EXPECT_EQ(history.frames()[1], (TimingParts{5.0, 0.0, 0.0, 5.0}));
}

TEST(TimingHistory, TheSameFrameCountsOnce) {
  TimingHistory history;
  history.add(snapshot(3, 10.0, 4.0, 2.0, 1.0));
  history.add(snapshot(3, 10.0, 4.0, 2.0, 1.0));
  EXPECT_EQ(history.frames().size(), 1U);
}

TEST(TimingHistory, ARunFromTheStartBeginsAnew) {
  TimingHistory history;
  history.add(snapshot(9, 100.0, 40.0, 20.0, 10.0));
  history.add(snapshot(0, 10.0, 4.0, 2.0, 1.0));
  ASSERT_EQ(history.frames().size(), 1U);
  EXPECT_EQ(history.frames()[0], (TimingParts{4.0, 2.0, 1.0, 3.0}));
}

TEST(TimingHistory, KeepsTheLastOnes) {
  TimingHistory history;
  for (std::uint64_t i = 0; i < 3 * TimingHistory::kLength; ++i) {
    const auto n = static_cast<double>(i + 1);
    history.add(snapshot(i, n * n, 0.0, 0.0, 0.0));
  }
  ASSERT_EQ(history.frames().size(), TimingHistory::kLength);
  const double last = 2.0 * 3.0 * static_cast<double>(TimingHistory::kLength) - 1.0;
  EXPECT_NEAR(history.frames().back()[3], last, 1e-6);
}

}  // namespace
}  // namespace cpslam::viewer
