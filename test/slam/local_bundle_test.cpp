#include "slam/local_bundle.h"

#include <gtest/gtest.h>

#include <mutex>
#include <shared_mutex>
#include <thread>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

class LocalBundle : public testing::Test {
 protected:
  LocalBundle() : mapped(300, scene::row_of_poses(5, 0.15), {.depth_share = 0.8, .noise_px = 0.2}, random) {}

  [[nodiscard]] double worst_pose_error() const {
    double worst = 0.0;
    for (std::size_t k = 0; k < mapped.keyframes.size(); ++k) {
      if (const KeyFrame* keyframe = mapped.map.keyframe(mapped.keyframes[k])) {
        worst =
            std::max(worst, synthetic::distance(keyframe->cam_from_world, mapped.views[k].cam_from_world));
      }
    }
    return worst;
  }
  Random random{31};
  scene::MappedWorld mapped;
  const std::atomic<bool> go_on = false;
};

TEST_F(LocalBundle, RecoversADisturbedMap) {
  mapped.disturb(random);
  ASSERT_GT(worst_pose_error(), 0.02);
  adjust_local_bundle(kRig, mapped.map, mapped.keyframes.back(), go_on);
  EXPECT_LT(worst_pose_error(), 0.003);
  double sum_m = 0.0;
  for (std::size_t p = 0; p < mapped.points.size(); ++p) {
    ASSERT_NE(mapped.map.point(mapped.points[p]), nullptr);
    sum_m += (mapped.map.point(mapped.points[p])->position_in_world - mapped.world.points[p]).norm();
  }
  EXPECT_LT(sum_m / 300.0, 0.005);
}

TEST_F(LocalBundle, TheFirstKeyFrameStaysBitByBit) {
  mapped.disturb(random);
  const SE3 before = mapped.map.keyframe(mapped.keyframes[0])->cam_from_world;
  adjust_local_bundle(kRig, mapped.map, mapped.keyframes[2], go_on);
  const SE3 after = mapped.map.keyframe(mapped.keyframes[0])->cam_from_world;
  EXPECT_EQ(before.rotation, after.rotation);
  EXPECT_EQ(before.translation, after.translation);
}

TEST_F(LocalBundle, RefreshesWhatDependsOnPositions) {
  mapped.disturb(random);
  adjust_local_bundle(kRig, mapped.map, mapped.keyframes.back(), go_on);
  const MapPoint& point = *mapped.map.point(mapped.points[0]);
  const float distance_m = point.max_distance_m;
  const Eigen::Vector3d normal = point.normal;
  mapped.map.refresh_point(mapped.points[0]);
  EXPECT_EQ(point.max_distance_m, distance_m);
  EXPECT_EQ(point.normal, normal);
}

TEST_F(LocalBundle, ObservationsThatDisagreeGo) {
  // A keypoint that two points swap in one view: both are wrong there.
  Map& map = mapped.map;
  const KeyFrameId id = mapped.keyframes[2];
  std::vector<std::size_t> swapped;
  for (std::size_t p = 0; p < 300 && swapped.size() < 2; ++p) {
    if (map.point(mapped.points[p])->observations.size() == 5) swapped.push_back(p);
  }
  ASSERT_EQ(swapped.size(), 2U);
  const int first = map.keypoint_of(mapped.points[swapped[0]], id);
  const int second = map.keypoint_of(mapped.points[swapped[1]], id);
  for (const std::size_t p : swapped) map.erase_observation(mapped.points[p], id);
  ASSERT_TRUE(map.add_observation(mapped.points[swapped[0]], {id, second}));
  ASSERT_TRUE(map.add_observation(mapped.points[swapped[1]], {id, first}));
  adjust_local_bundle(kRig, map, id, go_on);
  for (const std::size_t p : swapped) {
    EXPECT_EQ(map.keypoint_of(mapped.points[p], id), -1);
    EXPECT_EQ(map.point(mapped.points[p])->observations.size(), 4U);
  }
  EXPECT_LT(worst_pose_error(), 0.003);
}

TEST_F(LocalBundle, WhatIsErasedMeanwhileStaysErased) {
  // Another thread takes points and keyframes away while the solver works. Whenever it comes in, before,
  // during or after, the map must be sound in the end.
  mapped.disturb(random);
  std::jthread eraser([this] {
    for (std::size_t p = 0; p < 100; ++p) {
      const std::unique_lock lock(mapped.map.mutex());
      mapped.map.erase_point(mapped.points[p]);
      if (p == 50) mapped.map.erase_keyframe(mapped.keyframes[3]);
    }
  });
  adjust_local_bundle(kRig, mapped.map, mapped.keyframes.back(), go_on);
  eraser.join();
  EXPECT_EQ(mapped.map.keyframe(mapped.keyframes[3]), nullptr);
  for (std::size_t p = 0; p < 100; ++p) EXPECT_EQ(mapped.map.point(mapped.points[p]), nullptr);
  EXPECT_LT(worst_pose_error(), 0.01);
}

TEST_F(LocalBundle, AbortLeavesASoundMap) {
  mapped.disturb(random);
  const double before = worst_pose_error();
  const std::atomic<bool> abort = true;
  adjust_local_bundle(kRig, mapped.map, mapped.keyframes.back(), abort);
  EXPECT_TRUE(std::isfinite(worst_pose_error()));
  EXPECT_LT(worst_pose_error(), 2.0 * before);
}

TEST(LocalBundleAlone, NothingToAdjust) {
  Random random(32);
  const std::atomic<bool> go_on = false;
  scene::MappedWorld lone(100, {SE3()}, {}, random);
  adjust_local_bundle(kRig, lone.map, lone.keyframes[0], go_on);
  EXPECT_EQ(lone.map.point(lone.points[5])->position_in_world, lone.world.points[5]);
  adjust_local_bundle(kRig, lone.map, KeyFrameId{}, go_on);
  EXPECT_EQ(lone.map.n_points(), 100U);
}

}  // namespace
}  // namespace cpslam
