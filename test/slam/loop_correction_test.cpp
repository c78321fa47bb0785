#include "slam/loop_correction.h"

#include <gtest/gtest.h>

#include "slam/loop_closing.h"
#include "slam/loop_scene.h"

namespace cpslam {
namespace {

using scene::kRig;

/// The loop of a walk that ends where it began, with its true matches.
VerifiedLoop true_loop(const scene::RoundWalk& walk) {
  VerifiedLoop loop;
  loop.edge = walk.true_edge(24, 0);
  loop.matches.resize(walk.views[24].point_of.size());
  for (std::size_t i = 0; i < loop.matches.size(); ++i) {
    const auto p = static_cast<std::size_t>(walk.views[24].point_of[i]);
    const int there = walk.views[0].keypoint_of[p];
    if (there < 0) continue;
    const MapPointId id = walk.map.keyframe(walk.keyframes[0])->points[static_cast<std::size_t>(there)];
    if (!id.valid()) continue;
    loop.matches[i] = {PointMatch::Kind::kMapPoint, id, walk.map.point(id)->position_in_world};
    ++loop.inliers;
  }
  return loop;
}

class LoopCorrection : public testing::Test {
 protected:
  scene::RoundWalk walk;
  StageTimer timer;
  const std::atomic<bool> go_on = false;
};

TEST_F(LoopCorrection, TheEndsMeetAndTheErrorIsSharedOut) {
  const double end_before = walk.pose_error(24);
  const double middle_before = walk.pose_error(12);
  const std::size_t points_before = walk.map.n_points();
  const auto error = close_loop(kRig, walk.map, true_loop(walk), timer, go_on);
  ASSERT_TRUE(error);
  EXPECT_GT(error->distance_m, 0.05);
  EXPECT_GT(error->angle_rad, 0.05);
  EXPECT_EQ(walk.pose_error(0), 0.0);
  EXPECT_LT(walk.pose_error(24), 0.25 * end_before);
  EXPECT_LT(walk.pose_error(12), 0.6 * middle_before);
  EXPECT_EQ(walk.map.keyframe(walk.keyframes[24])->loops, std::vector{walk.keyframes[0]});
  EXPECT_EQ(walk.map.keyframe(walk.keyframes[0])->loops, std::vector{walk.keyframes[24]});
  EXPECT_EQ(walk.map.corrections(), 1U);
  EXPECT_LT(walk.map.n_points(), points_before - 200) << "what both sides had twice is one";
}

TEST_F(LoopCorrection, TheSidesShareTheirPointsAfterwards) {
  const auto shared = [&](std::size_t a, std::size_t b) {
    int n = 0;
    for (const Covisible& edge : walk.map.keyframe(walk.keyframes[a])->covisible) {
      if (edge.keyframe == walk.keyframes[b]) n = edge.shared_points;
    }
    return n;
  };
  ASSERT_EQ(shared(24, 0), 0);
  ASSERT_TRUE(close_loop(kRig, walk.map, true_loop(walk), timer, go_on));
  EXPECT_GT(shared(24, 0), 150);
  EXPECT_GT(shared(25, 1), 150) << "neighbours, by projection";
  EXPECT_EQ(shared(12, 0), 0);
}

TEST_F(LoopCorrection, EveryPointStaysWhereItsKeyframesSeeIt) {
  ASSERT_TRUE(close_loop(kRig, walk.map, true_loop(walk), timer, go_on));
  double sum_px = 0.0;
  int n = 0;
  for (const MapPointId id : walk.map.point_ids()) {
    const MapPoint& point = *walk.map.point(id);
    for (const Observation& seen : point.observations) {
      const KeyFrame& keyframe = *walk.map.keyframe(seen.keyframe);
      const Keypoint& k = keyframe.features->keypoints[static_cast<std::size_t>(seen.keypoint)];
      const Eigen::Vector2d uv = kRig.camera.project(keyframe.cam_from_world * point.position_in_world);
      sum_px += (uv - Eigen::Vector2d(k.x, k.y)).norm();
      ++n;
    }
  }
  EXPECT_LT(sum_px / n, 8.0) << "the drift of a few steps, of some 10 px each, is in it";
}

TEST_F(LoopCorrection, ARaisedFlagOrALostEndLeavesTheMapAsItWas) {
  const double before = walk.pose_error(24);
  const std::atomic<bool> abort = true;
  EXPECT_FALSE(close_loop(kRig, walk.map, true_loop(walk), timer, abort));
  EXPECT_EQ(walk.pose_error(24), before);
  const VerifiedLoop loop = true_loop(walk);
  ASSERT_TRUE(walk.map.erase_keyframe(walk.keyframes[24]));
  EXPECT_FALSE(close_loop(kRig, walk.map, loop, timer, go_on));
  EXPECT_EQ(walk.map.corrections(), 0U);
}

TEST(LoopClosingTest, FindsTheLoopOfARoundWalkAndOnlyThat) {
  // Two rounds and a half, one keyframe after the other as LocalMapping hands them on.
  scene::RoundWalk walk({.keyframes = 34});
  const std::unique_ptr<Places> places = scene::places_of(walk);
  StageTimer timer;
  const std::atomic<bool> go_on = false;
  LoopClosing loops(kRig, walk.map, *places, timer, Log(LogSink{}));
  std::vector<std::size_t> closed_at;
  for (std::size_t i = 0; i < walk.keyframes.size(); ++i) {
    places->remember(walk.map, walk.keyframes[i]);
    const auto loop = loops.find(walk.keyframes[i]);
    if (!loop) continue;
    ASSERT_GE(i, 23U) << "nothing was seen twice before";
    const LoopEdge& edge = loop->edge;
    const auto matched = static_cast<std::size_t>(
        std::find(walk.keyframes.begin(), walk.keyframes.end(), edge.matched) - walk.keyframes.begin());
    EXPECT_LT(synthetic::distance(edge.current_from_matched, walk.true_edge(i, matched).current_from_matched),
              0.03);
    ASSERT_TRUE(loops.close(*loop, go_on));
    closed_at.push_back(i);
  }
  ASSERT_EQ(closed_at.size(), 1U);
  EXPECT_LE(closed_at[0], 29U) << "four consistent keyframes after the first common view";
  for (std::size_t i = 24; i <= closed_at[0]; ++i) EXPECT_LT(walk.pose_error(i), 0.03) << i;
  const LoopStatistics statistics = loops.statistics();
  ASSERT_EQ(statistics.events.size(), 1U);
  EXPECT_EQ(statistics.events[0].time_s, 0.5 * static_cast<double>(closed_at[0]));
  EXPECT_LT(statistics.events[0].matched_time_s, 6.0);
  EXPECT_GT(statistics.events[0].error_deg, 2.0);
}

}  // namespace
}  // namespace cpslam
