#include "slam/keyframe_decision.h"

#include <gtest/gtest.h>

namespace cpslam {
namespace {

constexpr KeyFrameEvidence kStrong{
    .inliers = 300, .best_inliers = 320, .close_tracked = 250, .close_untracked = 200};

KeyFrameEvidence with(void (*change)(KeyFrameEvidence&)) {
  KeyFrameEvidence evidence = kStrong;
  change(evidence);
  return evidence;
}

TEST(KeyFrameDecision, StrongTrackingNeedsNone) {
  EXPECT_FALSE(wants_keyframe(kStrong));
}

TEST(KeyFrameDecision, WeakAgainstTheBestView) {
  EXPECT_FALSE(wants_keyframe(with([](KeyFrameEvidence& e) { e.inliers = 256; }))) << "just 80 %";
  EXPECT_TRUE(wants_keyframe(with([](KeyFrameEvidence& e) { e.inliers = 255; })));
}

TEST(KeyFrameDecision, CloseThingsThatAreNotInTheMap) {
  EXPECT_TRUE(wants_keyframe(with([](KeyFrameEvidence& e) {
    e.close_tracked = 99;
    e.close_untracked = 71;
  })));
  EXPECT_FALSE(wants_keyframe(with([](KeyFrameEvidence& e) {
    e.close_tracked = 100;
    e.close_untracked = 71;
  })));
  EXPECT_FALSE(wants_keyframe(with([](KeyFrameEvidence& e) {
    e.close_tracked = 99;
    e.close_untracked = 70;
  })));
}

TEST(KeyFrameDecision, NotFromAPoseThatHardlyStands) {
  EXPECT_FALSE(wants_keyframe(with([](KeyFrameEvidence& e) { e.inliers = 15; })));
  EXPECT_TRUE(wants_keyframe(with([](KeyFrameEvidence& e) { e.inliers = 16; })));
}

TEST(KeyFrameDecision, BusyMapperGetsTheUrgentOnly) {
  EXPECT_FALSE(wants_keyframe(with([](KeyFrameEvidence& e) {
    e.inliers = 200;
    e.mapper_load = MapperLoad::kBusy;
  })));
  EXPECT_TRUE(wants_keyframe(with([](KeyFrameEvidence& e) {
    e.inliers = 79;
    e.mapper_load = MapperLoad::kBusy;
  })));
  EXPECT_TRUE(wants_keyframe(with([](KeyFrameEvidence& e) {
    e.close_tracked = 50;
    e.close_untracked = 100;
    e.mapper_load = MapperLoad::kBusy;
  })));
}

TEST(KeyFrameDecision, FullMapperGetsNone) {
  EXPECT_FALSE(wants_keyframe(with([](KeyFrameEvidence& e) {
    e.inliers = 40;
    e.close_tracked = 0;
    e.mapper_load = MapperLoad::kFull;
  })));
}

}  // namespace
}  // namespace cpslam
