#include "slam/full_bundle.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

class FullBundleTest : public testing::Test {
 protected:
  FullBundleTest() : mapped(400, row_to_the_origin(), {.depth_share = 0.8, .noise_px = 0.2}, random) {
    mapped.disturb(random);
  }
  /// The last camera sees all points, the first one the fewest.
  static std::vector<SE3> row_to_the_origin() {
    std::vector<SE3> poses = scene::row_of_poses(8, 0.12);
    std::reverse(poses.begin(), poses.end());
    return poses;
  }
  [[nodiscard]] double pose_error(std::size_t k) const {
    return synthetic::distance(mapped.map.keyframe(mapped.keyframes[k])->cam_from_world,
                               mapped.views[k].cam_from_world);
  }

  Random random{51};
  scene::MappedWorld mapped;
  const std::atomic<bool> go_on = false;
};

TEST_F(FullBundleTest, TheCostFallsAndADisturbedMapRecovers) {
  ASSERT_GT(pose_error(5), 0.01);
  const auto bundle = adjust_full_bundle(kRig, mapped.map, go_on);
  ASSERT_TRUE(bundle);
  EXPECT_LT(bundle->result.final_cost, 0.1 * bundle->result.initial_cost);
  EXPECT_GT(pose_error(5), 0.01) << "the map is left alone until the result is written back";
  write_back(mapped.map, *bundle);
  for (std::size_t k = 0; k < mapped.keyframes.size(); ++k) EXPECT_LT(pose_error(k), 0.003) << k;
  double sum_m = 0.0;
  for (std::size_t p = 0; p < mapped.points.size(); ++p) {
    ASSERT_NE(mapped.map.point(mapped.points[p]), nullptr);
    sum_m += (mapped.map.point(mapped.points[p])->position_in_world - mapped.world.points[p]).norm();
  }
  EXPECT_LT(sum_m / 400.0, 0.005);
  EXPECT_EQ(mapped.map.corrections(), 1U);
}

TEST_F(FullBundleTest, WhatCameMeanwhileIsCarriedAlong) {
  const auto bundle = adjust_full_bundle(kRig, mapped.map, go_on);
  ASSERT_TRUE(bundle);
  // A keyframe that tracking put in beside the last one, as wrong as that one is, with points of its own.
  const SE3 step(so3_exp({0.0, 0.02, 0.0}), {-0.05, 0.0, 0.0});
  const SE3 last = mapped.map.keyframe(mapped.keyframes.back())->cam_from_world;
  const SE3 true_pose = step * mapped.views.back().cam_from_world;
  const KeyFrameId young = mapped.add_view(true_pose, {.depth_share = 1.0}, random);
  mapped.map.set_pose(young, step * last);
  ASSERT_EQ(mapped.map.keyframe(young)->parent, mapped.keyframes[7]);
  const Eigen::Vector3d in_camera(0.2, 0.1, 2.0);
  mapped.map.erase_observation(mapped.map.keyframe(young)->points[0], young);
  const MapPointId point = mapped.map.add_point((step * last).inverse() * in_camera, {young, 0});
  ASSERT_TRUE(point.valid());

  write_back(mapped.map, *bundle);
  EXPECT_LT(synthetic::distance(mapped.map.keyframe(young)->cam_from_world, true_pose), 0.004);
  EXPECT_LT((mapped.map.point(point)->position_in_world - true_pose.inverse() * in_camera).norm(), 0.008);
}

TEST_F(FullBundleTest, WhatIsErasedMeanwhileIsLeftOut) {
  const auto bundle = adjust_full_bundle(kRig, mapped.map, go_on);
  ASSERT_TRUE(bundle);
  for (std::size_t p = 0; p < 50; ++p) mapped.map.erase_point(mapped.points[p]);
  ASSERT_TRUE(mapped.map.erase_keyframe(mapped.keyframes[4]));
  write_back(mapped.map, *bundle);
  EXPECT_EQ(mapped.map.keyframe(mapped.keyframes[4]), nullptr);
  for (std::size_t p = 0; p < 50; ++p) EXPECT_EQ(mapped.map.point(mapped.points[p]), nullptr);
  EXPECT_LT(pose_error(7), 0.003);
}

TEST_F(FullBundleTest, ARaisedFlagLeavesTheMapAsItWas) {
  const std::atomic<bool> abort = true;
  EXPECT_FALSE(adjust_full_bundle(kRig, mapped.map, abort));
  EXPECT_EQ(mapped.map.corrections(), 0U);
}

TEST(FullBundleAlone, OneKeyframeIsNothingToAdjust) {
  Random random(52);
  const std::atomic<bool> go_on = false;
  const Map empty(kRig.pyramid);
  EXPECT_FALSE(adjust_full_bundle(kRig, empty, go_on));
  const scene::MappedWorld lone(100, {SE3()}, {}, random);
  EXPECT_FALSE(adjust_full_bundle(kRig, lone.map, go_on));
}

}  // namespace
}  // namespace cpslam
