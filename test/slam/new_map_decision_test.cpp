#include "slam/new_map_decision.h"

#include <gtest/gtest.h>

namespace cpslam {
namespace {

constexpr double kFrameS = 0.1;

/// Feeds frames at 10 Hz.
class NewMapDecisionTest : public testing::Test {
 protected:
  void track(int frames, bool keyframes = false) {
    for (int i = 0; i < frames; ++i) decision_.found(time_s_ += kFrameS, keyframes);
  }
  /// How many lost frames until a map is due; -1 when it is not within so many.
  int lost_until_due(int frames, bool shows_something = true) {
    for (int i = 1; i <= frames; ++i) {
      if (decision_.is_due(time_s_ += kFrameS, shows_something)) return i;
    }
    return -1;
  }
  void begin() {
    decision_.begun();
    decision_.found(time_s_, true);
  }
  double time_s_ = 100.0;
  NewMapDecision decision_{2.0};
};

TEST_F(NewMapDecisionTest, IsDueAfterTheTime) {
  track(5);
  EXPECT_NEAR(lost_until_due(50), 20, 1);
}

TEST_F(NewMapDecisionTest, NeverMeansNever) {
  decision_ = NewMapDecision(0.0);
  track(5);
  EXPECT_EQ(lost_until_due(1000), -1);
}

TEST_F(NewMapDecisionTest, ACoveredLensSeesNoPlace) {
  track(5);
  EXPECT_EQ(lost_until_due(100, false), -1);
  EXPECT_NEAR(lost_until_due(50), 20, 1) << "the covered time does not count";
}

TEST_F(NewMapDecisionTest, WhatWasSeenBeforeTheLensWasCoveredDoesNotCount) {
  track(5);
  EXPECT_EQ(lost_until_due(15), -1);
  EXPECT_EQ(lost_until_due(10, false), -1);
  EXPECT_NEAR(lost_until_due(50), 20, 1);
}

TEST_F(NewMapDecisionTest, ABlurredFrameIsNoCoveredLens) {
  track(5);
  EXPECT_EQ(lost_until_due(15), -1);
  EXPECT_EQ(lost_until_due(2, false), -1);
  EXPECT_LE(lost_until_due(50), 6);
}

TEST_F(NewMapDecisionTest, EveryFrameThatIsFoundBeginsAnew) {
  track(5);
  EXPECT_EQ(lost_until_due(15), -1);
  track(1);
  EXPECT_NEAR(lost_until_due(50), 20, 1);
}

TEST_F(NewMapDecisionTest, FramesThatComeSeldomAreNotTakenForALongLook) {
  decision_.found(0.0, false);
  int frames = 1;
  while (!decision_.is_due(10.0 * frames, true)) ++frames;
  EXPECT_EQ(frames, 4);
}

TEST_F(NewMapDecisionTest, MapsThatAreLostAtOnceDoNotPileUp) {
  track(5);
  ASSERT_NEAR(lost_until_due(50), 20, 1);
  begin();
  for (const int expected : {40, 80, 160, 320, 320}) {
    EXPECT_NEAR(lost_until_due(1000), expected, 1);
    begin();
  }
  track(10, true);
  EXPECT_NEAR(lost_until_due(1000), 20, 1) << "the last one stood firm";
  begin();
  EXPECT_NEAR(lost_until_due(1000), 40, 1);
}

}  // namespace
}  // namespace cpslam
