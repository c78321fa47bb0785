#include "slam/motion_tracker.h"

#include <gtest/gtest.h>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;
using Kind = PointMatch::Kind;

class MotionTracker : public testing::Test {
 protected:
  /// The last frame, matched to the map but for every fourth keypoint.
  Frame last_frame() {
    const synthetic::View view = synthetic::look(mapped.world, {}, {}, random);
    Frame last = scene::make_frame(view);
    for (std::size_t i = 0; i < last.matches.size(); ++i) {
      const auto p = static_cast<std::size_t>(view.point_of[i]);
      if (i % 4 != 0) last.matches[i] = {Kind::kMapPoint, mapped.points[p], mapped.world.points[p]};
    }
    return last;
  }
  Random random{71};
  scene::MappedWorld mapped{300, {SE3()}, {}, random};
};

TEST_F(MotionTracker, TemporaryPointsComeFromDepth) {
  Frame last = last_frame();
  auto features = std::make_shared<FrameFeatures>(*last.features);
  features->depth_m[0] = 0.0F;
  features->depth_m[4] = static_cast<float>(kRig.close_depth_m) + 0.1F;
  last.features = features;
  add_temporary_points(kRig, last);
  EXPECT_EQ(last.matches[0].kind, Kind::kNone) << "no depth";
  EXPECT_EQ(last.matches[4].kind, Kind::kNone) << "not close";
  EXPECT_EQ(last.matches[1].kind, Kind::kMapPoint);
  ASSERT_EQ(last.matches[8].kind, Kind::kTemporary);
  EXPECT_FALSE(last.matches[8].id.valid());
  EXPECT_NEAR(last.matches[8].position_in_world.z(), features->depth_m[8], 1e-5);
}

TEST_F(MotionTracker, RefreshFollowsTheMap) {
  Frame last = last_frame();
  add_temporary_points(kRig, last);
  const Eigen::Vector3d temporary = last.matches[0].position_in_world;
  const Eigen::Vector3d erased = last.matches[1].position_in_world;
  mapped.map.erase_point(last.matches[1].id);
  mapped.map.set_position(last.matches[2].id, {1.0, 2.0, 3.0});
  refresh_frame(mapped.map, last.cam_from_world, last);
  EXPECT_EQ(last.matches[0].position_in_world, temporary);
  EXPECT_EQ(last.matches[1].kind, Kind::kTemporary);
  EXPECT_EQ(last.matches[1].position_in_world, erased);
  EXPECT_EQ(last.matches[2].position_in_world, Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST_F(MotionTracker, RefreshCarriesTemporaryPointsWithTheCamera) {
  Frame last = last_frame();
  add_temporary_points(kRig, last);
  ASSERT_EQ(last.matches[0].kind, Kind::kTemporary);
  const Eigen::Vector3d in_camera = last.cam_from_world * last.matches[0].position_in_world;
  const SE3 corrected = synthetic::moved(last.cam_from_world, {0.3, 0.1, -0.2}, 0.2);
  refresh_frame(mapped.map, corrected, last);
  EXPECT_EQ(last.cam_from_world.translation, corrected.translation);
  EXPECT_TRUE((corrected * last.matches[0].position_in_world).isApprox(in_camera, 1e-12));
}

TEST_F(MotionTracker, FindsTheMotion) {
  Frame last = last_frame();
  add_temporary_points(kRig, last);
  const SE3 truth = synthetic::moved({}, {0.02, 0.01, 0.02}, 0.005);
  Frame frame = mapped.frame_at(truth, {.depth_share = 0.8, .noise_px = 0.3, .bit_flips = 15}, random);
  frame.cam_from_world = SE3();
  const int inliers = track_from_last_frame(kRig, last, 15.0F, frame);
  EXPECT_GT(inliers, 200);
  EXPECT_LT(synthetic::distance(frame.cam_from_world, truth), 0.005);
  int map_points = 0;
  int temporary = 0;
  for (const PointMatch& match : frame.matches) {
    map_points += match.kind == Kind::kMapPoint ? 1 : 0;
    temporary += match.kind == Kind::kTemporary ? 1 : 0;
  }
  EXPECT_EQ(map_points + temporary, inliers);
  EXPECT_GT(map_points, 2 * temporary);
  EXPECT_GT(temporary, 30);
}

TEST_F(MotionTracker, LargeMotionNeedsAWiderWindow) {
  const Frame last = last_frame();
  const SE3 truth = synthetic::moved({}, Eigen::Vector3d::Zero(), 0.09);  // 47 px at the image's centre
  Frame frame = mapped.frame_at(truth, {}, random);
  frame.cam_from_world = SE3();
  EXPECT_EQ(track_from_last_frame(kRig, last, 15.0F, frame), 0);
  EXPECT_LT(synthetic::distance(frame.cam_from_world, SE3()), 1e-15) << "the prediction stays";
  for (const PointMatch& match : frame.matches) EXPECT_EQ(match.kind, Kind::kNone);
  EXPECT_GT(track_from_last_frame(kRig, last, 60.0F, frame), 100);
  EXPECT_LT(synthetic::distance(frame.cam_from_world, truth), 0.005);
}

TEST_F(MotionTracker, TooFewMatchesMakeNoPose) {
  Frame last = last_frame();
  for (std::size_t i = 25; i < last.matches.size(); ++i) last.matches[i] = {};  // leaves 18
  Frame frame = mapped.frame_at({}, {}, random);
  EXPECT_EQ(track_from_last_frame(kRig, last, 15.0F, frame), 0);
  Frame empty;
  empty.features = synthetic::make_features({});
  EXPECT_EQ(track_from_last_frame(kRig, last_frame(), 15.0F, empty), 0);
}

}  // namespace
}  // namespace cpslam
