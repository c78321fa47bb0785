// What a culled keyframe leaves behind: its pose relative to those that live on.
#include <gtest/gtest.h>

#include "map/map_builder.h"

namespace cpslam {
namespace {

using test::add_keyframe;
using test::blank_features;
using test::share_points;

SE3 pose(double x, double angle_rad) {
  return {so3_exp({0.1, angle_rad, -0.2}), {x, 0.2, 0.3}};
}

/// Keyframes 0 to 4, each the child of the one before.
class TombstoneTest : public testing::Test {
 protected:
  TombstoneTest() {
    for (std::size_t i = 0; i < 5; ++i) {
      const auto n = static_cast<double>(i);
      ids.push_back(add_keyframe(map, blank_features(60), pose(n, 0.1 * n)));
      if (i > 0) share_points(map, ids[i - 1], ids[i], 20);
      map.update_covisibility(ids[i]);
    }
  }
  double pose_error(std::size_t i, const SE3& expected) const {
    return synthetic::distance(map.cam_from_world(ids[i]).value(), expected);
  }
  Map map{synthetic::pyramid()};
  std::vector<KeyFrameId> ids;
};

TEST_F(TombstoneTest, CulledKeyFrameKeepsItsPose) {
  ASSERT_TRUE(map.erase_keyframe(ids[2]));
  EXPECT_EQ(map.keyframe(ids[2]), nullptr);
  EXPECT_LT(pose_error(2, pose(2.0, 0.2)), 1e-12);
  EXPECT_EQ(map.living(ids[2]), ids[1]);
  EXPECT_EQ(map.living(ids[3]), ids[3]);
}

TEST_F(TombstoneTest, CulledKeyFrameFollowsItsParent) {
  ASSERT_TRUE(map.erase_keyframe(ids[2]));
  const SE3 world_from_new_world = pose(-3.0, 0.7);
  map.set_pose(ids[1], pose(1.0, 0.1) * world_from_new_world);
  EXPECT_LT(pose_error(2, pose(2.0, 0.2) * world_from_new_world), 1e-12);
  EXPECT_LT(pose_error(3, pose(3.0, 0.3)), 1e-12) << "the living stay where they are";
}

TEST_F(TombstoneTest, ChainOfCulledKeyFramesFollowsTheLivingAncestor) {
  // Both orders: the parent before and after its child.
  ASSERT_TRUE(map.erase_keyframe(ids[3]));
  ASSERT_TRUE(map.erase_keyframe(ids[2]));
  ASSERT_TRUE(map.erase_keyframe(ids[4]));
  EXPECT_EQ(map.living(ids[4]), ids[1]);
  EXPECT_EQ(map.living(ids[3]), ids[1]);
  const SE3 world_from_new_world = pose(5.0, -0.4);
  map.set_pose(ids[1], pose(1.0, 0.1) * world_from_new_world);
  for (std::size_t i = 2; i < 5; ++i) {
    const auto n = static_cast<double>(i);
    EXPECT_LT(pose_error(i, pose(n, 0.1 * n) * world_from_new_world), 1e-11) << i;
  }
}

TEST_F(TombstoneTest, CulledIdIsNotConfusedWithTheHeirOfItsSlot) {
  ASSERT_TRUE(map.erase_keyframe(ids[2]));
  const KeyFrameId heir = add_keyframe(map, blank_features(5), pose(9.0, 1.0));
  ASSERT_EQ(heir.index, ids[2].index);
  EXPECT_LT(pose_error(2, pose(2.0, 0.2)), 1e-12);
  EXPECT_LT(synthetic::distance(map.cam_from_world(heir).value(), pose(9.0, 1.0)), 1e-12);
}

TEST_F(TombstoneTest, UnknownIdsHaveNoPose) {
  EXPECT_FALSE(map.cam_from_world(KeyFrameId{}).has_value());
  EXPECT_FALSE(map.cam_from_world({99, 0}).has_value());
  EXPECT_FALSE(map.living({99, 0}).valid());
}

}  // namespace
}  // namespace cpslam
