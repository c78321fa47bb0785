#include "slam/recent_points.h"

#include <gtest/gtest.h>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

/// Keyframes that come one after the other, and what becomes of one point made by the first.
class RecentPointsTest : public testing::Test {
 protected:
  KeyFrameId next_keyframe() {
    const std::vector<synthetic::Spot> spots{{.x = 10.0, .y = 10.0, .descriptor = {}, .depth_m = 2.0},
                                             {.x = 30.0, .y = 10.0, .descriptor = {}, .depth_m = 2.0}};
    KeyFrame keyframe;
    keyframe.features = synthetic::make_features(spots);
    return map.add_keyframe(std::move(keyframe));
  }
  void count(int visible, int found) {
    for (int i = 1; i < visible; ++i) map.count_visible(point, i < found);
  }
  [[nodiscard]] bool alive() const { return map.point(point) != nullptr; }

  Map map{kRig.pyramid};
  RecentPoints recent;
  const KeyFrameId first = next_keyframe();
  const MapPointId point = map.add_point({0.0, 0.0, 2.0}, {first, 0});
};

TEST_F(RecentPointsTest, PointThatNobodySeesAgainGoesWithTheSecondKeyFrameAfter) {
  recent.cull(map, first);
  recent.cull(map, next_keyframe());
  EXPECT_TRUE(alive());
  recent.cull(map, next_keyframe());
  EXPECT_FALSE(alive());
  EXPECT_EQ(map.n_points(), 0U);
}

TEST_F(RecentPointsTest, PointSeenAgainStays) {
  recent.cull(map, first);
  const KeyFrameId second = next_keyframe();
  map.add_observation(point, {second, 0});
  for (int i = 0; i < 6; ++i) recent.cull(map, i == 0 ? second : next_keyframe());
  EXPECT_TRUE(alive());
}

TEST_F(RecentPointsTest, PointFoundInLessThanAQuarterOfItsFramesGoes) {
  recent.cull(map, first);
  map.add_observation(point, {next_keyframe(), 0});
  count(40, 10);
  recent.cull(map, next_keyframe());
  EXPECT_TRUE(alive()) << "just a quarter";
  map.count_visible(point, false);
  recent.cull(map, next_keyframe());
  EXPECT_FALSE(alive());
}

TEST_F(RecentPointsTest, ProbationEndsAfterThreeKeyFrames) {
  recent.cull(map, first);
  map.add_observation(point, {next_keyframe(), 0});
  for (int i = 0; i < 3; ++i) recent.cull(map, next_keyframe());
  count(100, 1);
  recent.cull(map, next_keyframe());
  EXPECT_TRUE(alive());
}

TEST_F(RecentPointsTest, PointsOfTheMapperAreOnProbationToo) {
  // One that is not the keyframe's own: made from an older keyframe's view.
  const KeyFrameId second = next_keyframe();
  recent.add({point});
  recent.cull(map, second);
  EXPECT_TRUE(alive());
  recent.cull(map, next_keyframe());
  EXPECT_FALSE(alive());
}

TEST_F(RecentPointsTest, WhatIsGoneIsForgotten) {
  recent.cull(map, first);
  map.erase_point(point);
  recent.cull(map, KeyFrameId{});
  recent.cull(map, next_keyframe());
  EXPECT_EQ(map.n_points(), 0U);
}

}  // namespace
}  // namespace cpslam
