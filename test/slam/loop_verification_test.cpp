#include "slam/loop_verification.h"

#include <gtest/gtest.h>

#include "slam/loop_scene.h"

namespace cpslam {
namespace {

using scene::kRig;

class LoopVerification : public testing::Test {
 protected:
  std::optional<VerifiedLoop> verify(const scene::RoundWalk& walk, std::size_t current,
                                     std::size_t candidate) {
    const std::unique_ptr<Places> places = scene::places_of(walk);
    const ImageWords a = places->vocabulary.transform(walk.views[current].features->descriptors);
    const ImageWords b = places->vocabulary.transform(walk.views[candidate].features->descriptors);
    return verify_loop(kRig, walk.map, walk.keyframes[current], walk.keyframes[candidate],
                       {a.features, b.features}, random);
  }
  Random random{61};
};

TEST_F(LoopVerification, FindsTheTruePoseWhateverTheDrift) {
  const scene::RoundWalk walk;
  ASSERT_GT(walk.pose_error(24), 0.1);
  const auto loop = verify(walk, 24, 0);
  ASSERT_TRUE(loop);
  EXPECT_EQ(loop->edge.current, walk.keyframes[24]);
  EXPECT_EQ(loop->edge.matched, walk.keyframes[0]);
  const LoopEdge truth = walk.true_edge(24, 0);
  EXPECT_LT(synthetic::distance(loop->edge.current_from_matched, truth.current_from_matched), 0.01);
  EXPECT_GE(loop->inliers, 100);
  int right = 0;
  int wrong = 0;
  for (std::size_t i = 0; i < loop->matches.size(); ++i) {
    if (loop->matches[i].kind != PointMatch::Kind::kMapPoint) continue;
    const int there = walk.map.keypoint_of(loop->matches[i].id, walk.keyframes[0]);
    if (there < 0) continue;
    const bool same = walk.views[0].point_of[static_cast<std::size_t>(there)] == walk.views[24].point_of[i];
    ++(same ? right : wrong);
  }
  EXPECT_GT(right, 50);
  EXPECT_LT(wrong, right / 50 + 1);
}

TEST_F(LoopVerification, ANeighbouringKeyframeWillDo) {
  const scene::RoundWalk walk;
  const auto loop = verify(walk, 25, 0);
  ASSERT_TRUE(loop);
  EXPECT_LT(synthetic::distance(loop->edge.current_from_matched, walk.true_edge(25, 0).current_from_matched),
            0.02);
}

TEST_F(LoopVerification, AnotherPlaceIsRefused) {
  const scene::RoundWalk walk;
  EXPECT_FALSE(verify(walk, 24, 8));
  EXPECT_FALSE(verify(walk, 24, 12));
}

TEST_F(LoopVerification, APlaceThatDriftCannotExplainIsRefused) {
  // The last keyframe sees the first one's place, to the last bit; but the map has it 3 m away after a short
  // way.
  scene::RoundWalk walk({.keyframes = 26});
  const SE3 far_off(so3_exp({0.0, 1.5, 0.0}), {3.0, 0.0, 0.0});
  ASSERT_TRUE(verify(walk, 24, 0));
  for (std::size_t i = 22; i < walk.keyframes.size(); ++i) {
    walk.map.set_pose(walk.keyframes[i], far_off * walk.map.keyframe(walk.keyframes[i])->cam_from_world);
  }
  EXPECT_FALSE(verify(walk, 24, 0));
}

TEST_F(LoopVerification, WhatIsCrowdedInACornerIsRefused) {
  // Twice the same small thing, some 20 pixels wide, in front of nothing else that is alike.
  scene::RoundWalk walk({.keyframes = 26, .points = 4000});
  const Eigen::Vector3d middle =
      walk.map.keyframe(walk.keyframes[0])->cam_from_world.inverse() * Eigen::Vector3d(0.0, 0.0, 2.2);
  int kept = 0;
  for (const MapPointId id : walk.map.point_ids()) {
    if (walk.map.keypoint_of(id, walk.keyframes[0]) < 0) continue;
    if ((walk.map.point(id)->position_in_world - middle).norm() < 0.2) {
      ++kept;
    } else {
      walk.map.erase_point(id);
    }
  }
  const auto loop = verify(walk, 24, 0);
  EXPECT_FALSE(loop) << kept << " points kept";
}

TEST_F(LoopVerification, KeyframesThatAreGoneAreRefused) {
  scene::RoundWalk walk;
  ASSERT_TRUE(walk.map.erase_keyframe(walk.keyframes[25]));
  ASSERT_TRUE(walk.map.erase_keyframe(walk.keyframes[1]));
  EXPECT_FALSE(verify(walk, 25, 0));
  EXPECT_FALSE(verify(walk, 24, 1));
}

}  // namespace
}  // namespace cpslam
