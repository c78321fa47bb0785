#include "slam/trajectory_log.h"

#include <gtest/gtest.h>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

class TrajectoryLogTest : public testing::Test {
 protected:
  [[nodiscard]] SE3 resolved(std::size_t i) const {
    return from_pose(log.resolve(mapped.map).at(i).world_from_camera).inverse();
  }
  Random random{51};
  scene::MappedWorld mapped{100, scene::row_of_poses(3, 0.1), {}, random};
  const SE3 cam_from_reference = synthetic::moved({}, {0.01, 0.02, 0.03}, 0.1);
  TrajectoryLog log;
};

TEST_F(TrajectoryLogTest, FramesFollowTheirReference) {
  log.add(1.5, mapped.keyframes[1], cam_from_reference);
  EXPECT_LT(synthetic::distance(resolved(0), cam_from_reference * mapped.views[1].cam_from_world), 1e-9);
  const SE3 moved = synthetic::moved({}, {1.0, 2.0, 3.0}, 0.5);
  mapped.map.set_pose(mapped.keyframes[1], moved);
  EXPECT_LT(synthetic::distance(resolved(0), cam_from_reference * moved), 1e-9);
  EXPECT_EQ(log.resolve(mapped.map)[0].time_s, 1.5);
}

TEST_F(TrajectoryLogTest, FramesOfACulledReferenceFollowItsParent) {
  log.add(1.5, mapped.keyframes[2], cam_from_reference);
  const KeyFrameId parent = mapped.map.keyframe(mapped.keyframes[2])->parent;
  const SE3 before = resolved(0);
  ASSERT_TRUE(mapped.map.erase_keyframe(mapped.keyframes[2]));
  EXPECT_LT(synthetic::distance(resolved(0), before), 1e-9);
  const SE3 world_from_new_world = synthetic::moved({}, {0.5, 0.0, 0.0}, 0.2);
  mapped.map.set_pose(parent, mapped.map.keyframe(parent)->cam_from_world * world_from_new_world);
  EXPECT_LT(synthetic::distance(resolved(0), before * world_from_new_world), 1e-9);
}

TEST_F(TrajectoryLogTest, KeyFramePosesAreThoseOfTheLivingInOrder) {
  ASSERT_TRUE(mapped.map.erase_keyframe(mapped.keyframes[1]));
  const Trajectory poses = keyframe_poses(mapped.map);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_LT(
      synthetic::distance(from_pose(poses[1].world_from_camera).inverse(), mapped.views[2].cam_from_world),
      1e-9);
}

TEST_F(TrajectoryLogTest, EmptyLogEmptyTrajectory) {
  EXPECT_TRUE(log.resolve(mapped.map).empty());
}

}  // namespace
}  // namespace cpslam
