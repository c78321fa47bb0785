#include "slam/map_correction.h"

#include <gtest/gtest.h>

#include "slam/loop_scene.h"

namespace cpslam {
namespace {

const SE3 kMove(so3_exp({0.1, 0.2, -0.1}), {0.5, -0.3, 0.2});  // world_new_from_world_old

TEST(MapCorrection, ARigidMoveOfAllKeyframesCarriesEverythingAlong) {
  scene::RoundWalk walk({.keyframes = 6});
  MapCorrection correction;
  std::vector<Eigen::Vector3d> before;
  for (const KeyFrameId id : walk.keyframes) {
    correction.cam_from_world[id] = walk.map.keyframe(id)->cam_from_world * kMove.inverse();
  }
  for (const MapPointId id : walk.map.point_ids()) before.push_back(walk.map.point(id)->position_in_world);
  const MapPoint sample = *walk.map.point(walk.map.point_ids()[7]);
  apply_correction(walk.map, correction);
  std::size_t i = 0;
  for (const MapPointId id : walk.map.point_ids()) {
    EXPECT_TRUE(walk.map.point(id)->position_in_world.isApprox(kMove * before[i++], 1e-9));
  }
  const MapPoint& moved = *walk.map.point(walk.map.point_ids()[7]);
  EXPECT_TRUE(moved.normal.isApprox(kMove.rotation * sample.normal, 1e-6)) << "normals turn with the world";
  EXPECT_NEAR(moved.max_distance_m, sample.max_distance_m, 1e-5);
  EXPECT_EQ(moved.descriptor, sample.descriptor);
  EXPECT_EQ(walk.map.corrections(), 1U);
}

TEST(MapCorrection, KeyframesThatCameMeanwhileFollowTheirParents) {
  scene::RoundWalk walk({.keyframes = 6});
  MapCorrection correction;
  for (const KeyFrameId id : walk.keyframes) {
    correction.cam_from_world[id] = walk.map.keyframe(id)->cam_from_world * kMove.inverse();
  }
  walk.add_keyframe_at(6 * walk.options.step_rad);
  walk.add_keyframe_at(7 * walk.options.step_rad);
  const SE3 first = walk.map.keyframe(walk.keyframes[6])->cam_from_world;
  const SE3 second = walk.map.keyframe(walk.keyframes[7])->cam_from_world;
  const MapPointId young = walk.map.point_ids().back();
  const Eigen::Vector3d position = walk.map.point(young)->position_in_world;
  apply_correction(walk.map, correction);
  EXPECT_LT(
      synthetic::distance(walk.map.keyframe(walk.keyframes[6])->cam_from_world, first * kMove.inverse()),
      1e-9);
  EXPECT_LT(
      synthetic::distance(walk.map.keyframe(walk.keyframes[7])->cam_from_world, second * kMove.inverse()),
      1e-9);
  EXPECT_TRUE(walk.map.point(young)->position_in_world.isApprox(kMove * position, 1e-9));
}

TEST(MapCorrection, PointsWithANewPlaceTakeIt) {
  scene::RoundWalk walk({.keyframes = 3});
  MapCorrection correction;
  for (const KeyFrameId id : walk.keyframes)
    correction.cam_from_world[id] = walk.map.keyframe(id)->cam_from_world;
  const std::vector<MapPointId> points = walk.map.point_ids();
  const Eigen::Vector3d stays = walk.map.point(points[1])->position_in_world;
  correction.point_in_world[points[0]] = {0.1, 0.2, 2.0};
  apply_correction(walk.map, correction);
  EXPECT_EQ(walk.map.point(points[0])->position_in_world, Eigen::Vector3d(0.1, 0.2, 2.0));
  EXPECT_TRUE(walk.map.point(points[1])->position_in_world.isApprox(stays, 1e-12));
}

TEST(MapCorrection, WhatIsGoneStaysGone) {
  scene::RoundWalk walk({.keyframes = 6});
  MapCorrection correction;
  for (const KeyFrameId id : walk.keyframes) {
    correction.cam_from_world[id] = walk.map.keyframe(id)->cam_from_world * kMove.inverse();
  }
  const MapPointId erased = walk.map.point_ids()[3];
  correction.point_in_world[erased] = {1.0, 1.0, 1.0};
  walk.map.erase_point(erased);
  ASSERT_TRUE(walk.map.erase_keyframe(walk.keyframes[3]));
  const SE3 culled = *walk.map.cam_from_world(walk.keyframes[3]);
  apply_correction(walk.map, correction);
  EXPECT_EQ(walk.map.point(erased), nullptr);
  EXPECT_EQ(walk.map.keyframe(walk.keyframes[3]), nullptr);
  EXPECT_LT(synthetic::distance(*walk.map.cam_from_world(walk.keyframes[3]), culled * kMove.inverse()), 1e-9)
      << "frames that hang on it move along";
}

}  // namespace
}  // namespace cpslam
