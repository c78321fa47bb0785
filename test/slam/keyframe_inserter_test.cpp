#include "slam/keyframe_inserter.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "slam/observation_model.h"
#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

constexpr std::size_t kAtLeast = 300;  // points with depth that a keyframe gets however far they are

std::size_t map_point_matches(const Frame& frame) {
  return static_cast<std::size_t>(
      std::count_if(frame.matches.begin(), frame.matches.end(),
                    [](const PointMatch& m) { return m.kind == PointMatch::Kind::kMapPoint; }));
}

void expect_frame_and_keyframe_agree(const Map& map, KeyFrameId id, const Frame& frame) {
  for (std::size_t i = 0; i < frame.matches.size(); ++i) {
    const bool matched = frame.matches[i].kind == PointMatch::Kind::kMapPoint;
    ASSERT_EQ(map.keyframe(id)->points[i].valid(), matched);
    if (!matched) continue;
    ASSERT_EQ(map.keyframe(id)->points[i], frame.matches[i].id);
    ASSERT_NE(map.point(frame.matches[i].id), nullptr);
  }
}

TEST(KeyFrameInserter, MakesPointsOfAllCloseKeypoints) {
  Random random(1);
  const synthetic::World world = synthetic::random_world(900, random, 1.0, 4.0);
  const SE3 pose = synthetic::moved({}, {0.1, 0.0, 0.0}, 0.05);
  Frame frame = scene::make_frame(synthetic::look(world, pose, {.depth_share = 0.7}, random), 1.25);
  Map map(kRig.pyramid);
  const KeyFrameId id = insert_keyframe(kRig, map, Placement{}, frame);
  EXPECT_EQ(map.keyframe(id)->time_s, 1.25);
  EXPECT_EQ(map.keyframe(id)->features, frame.features);
  expect_frame_and_keyframe_agree(map, id, frame);
  std::size_t close = 0;
  for (std::size_t i = 0; i < frame.matches.size(); ++i) {
    const double depth_m = frame.features->depth_m[i];
    const bool is_close = depth_m > 0.0 && depth_m <= kRig.close_depth_m;
    close += is_close ? 1U : 0U;
    EXPECT_EQ(frame.matches[i].kind == PointMatch::Kind::kMapPoint, is_close) << i << ": " << depth_m << " m";
    if (!is_close) continue;
    const Eigen::Vector3d in_camera = pose * map.point(frame.matches[i].id)->position_in_world;
    EXPECT_NEAR(in_camera.z(), depth_m, 1e-5);
    EXPECT_LT(chi2(kRig, observe(kRig, *frame.features, static_cast<int>(i)), in_camera), 1e-6);
  }
  EXPECT_GT(close, kAtLeast) << "else the test says nothing";
}

TEST(KeyFrameInserter, FarRoomsGetTheNearest) {
  Random random(2);
  const synthetic::World world = synthetic::random_world(500, random, 4.0, 8.0);
  Frame frame = scene::make_frame(synthetic::look(world, {}, {}, random));
  Map map(kRig.pyramid);
  insert_keyframe(kRig, map, Placement{}, frame);
  EXPECT_EQ(map_point_matches(frame), kAtLeast);
  float farthest_in = 0.0F;
  float nearest_out = 100.0F;
  for (std::size_t i = 0; i < frame.matches.size(); ++i) {
    const float depth_m = frame.features->depth_m[i];
    if (frame.matches[i].kind == PointMatch::Kind::kMapPoint) {
      farthest_in = std::max(farthest_in, depth_m);
    } else {
      nearest_out = std::min(nearest_out, depth_m);
    }
  }
  EXPECT_LE(farthest_in, nearest_out);
}

TEST(KeyFrameInserter, ObservesWhatTheFrameWasMatchedTo) {
  Random random(3);
  scene::MappedWorld mapped(200, {SE3()}, {}, random);
  const synthetic::View view =
      synthetic::look(mapped.world, synthetic::moved({}, {0.05, 0.0, 0.0}), {}, random);
  Frame frame = scene::make_frame(view);
  int erased_keypoint = -1;
  int temporary_keypoint = -1;
  for (std::size_t i = 0; i < view.point_of.size(); ++i) {
    const auto p = static_cast<std::size_t>(view.point_of[i]);
    if (i == 0) {
      temporary_keypoint = 0;
      frame.matches[i] = {PointMatch::Kind::kTemporary, {}, mapped.world.points[p]};
      continue;
    }
    frame.matches[i] = {PointMatch::Kind::kMapPoint, mapped.points[p], mapped.world.points[p]};
    if (i == 1) {
      erased_keypoint = 1;
      mapped.map.erase_point(mapped.points[p]);
    }
  }
  // Two keypoints with one point: only the first can have it.
  frame.matches[3] = frame.matches[2];
  const MapPointId of_both = frame.matches[2].id;
  const std::vector<PointMatch> before = frame.matches;
  Placement placement;
  placement.reference = mapped.keyframes[0];
  placement.reference_from_world = mapped.views[0].cam_from_world;
  const KeyFrameId id = insert_keyframe(kRig, mapped.map, placement, frame);
  expect_frame_and_keyframe_agree(mapped.map, id, frame);
  EXPECT_NE(frame.matches[static_cast<std::size_t>(erased_keypoint)].id, before[1].id)
      << "a new point in its place";
  EXPECT_EQ(frame.matches[static_cast<std::size_t>(temporary_keypoint)].kind, PointMatch::Kind::kMapPoint);
  EXPECT_EQ(frame.matches[2].id, of_both);
  EXPECT_NE(frame.matches[3].id, of_both);
  for (std::size_t i = 4; i < before.size(); ++i) EXPECT_EQ(frame.matches[i].id, before[i].id);
  EXPECT_EQ(mapped.map.keyframe(id)->parent, mapped.keyframes[0]);
  EXPECT_EQ(mapped.map.best_covisible(id, 5), std::vector<KeyFrameId>{mapped.keyframes[0]});
}

TEST(KeyFrameInserter, WithoutAReferenceASessionBegins) {
  Random random(5);
  const synthetic::World world = synthetic::random_world(300, random, 1.0, 4.0);
  Map map(kRig.pyramid);
  std::vector<KeyFrameId> ids;
  for (int i = 0; i < 3; ++i) {
    Frame frame = scene::make_frame(synthetic::look(world, {}, {}, random), i);
    Placement placement;
    if (i == 2) placement.reference = ids[0];
    ids.push_back(insert_keyframe(kRig, map, placement, frame));
  }
  EXPECT_EQ(map.session_of(ids[0]), 1);
  EXPECT_EQ(map.session_of(ids[1]), 2);
  EXPECT_EQ(map.session_of(ids[2]), 1) << "that of its reference";
  EXPECT_TRUE(map.is_root(ids[1]));
}

TEST(KeyFrameInserter, FollowsAReferenceThatTheMapperMovedMeanwhile) {
  Random random(3);
  const synthetic::World world = synthetic::random_world(300, random, 1.0, 4.0);
  const SE3 first_pose = synthetic::moved({}, {0.1, 0.0, 0.0}, 0.05);
  Map map(kRig.pyramid);
  Frame first = scene::make_frame(synthetic::look(world, first_pose, {}, random), 1.0);
  const KeyFrameId reference = insert_keyframe(kRig, map, Placement{}, first);

  Placement placement;
  placement.reference = reference;
  placement.reference_from_world = map.keyframe(reference)->cam_from_world;
  const SE3 second_pose = synthetic::moved(first_pose, {0.0, 0.05, 0.0}, 0.02);
  const synthetic::View view = synthetic::look(world, second_pose, {}, random);
  Frame second = scene::make_frame(view, 2.0);
  second.cam_from_world = second_pose;
  const SE3 correction =
      SE3::exp((Eigen::Matrix<double, 6, 1>() << 0.02, -0.01, 0.03, 0.01, 0.0, -0.02).finished());
  map.set_pose(reference, placement.reference_from_world * correction);
  const KeyFrameId id = insert_keyframe(kRig, map, placement, second);

  const SE3 expected = second_pose * correction;
  const SE3 error = map.keyframe(id)->cam_from_world * expected.inverse();
  EXPECT_LT(error.log().norm(), 1e-9);
  const SE3 frame_error = second.cam_from_world * expected.inverse();
  EXPECT_LT(frame_error.log().norm(), 1e-9) << "the frame's own pose goes along";
}

}  // namespace
}  // namespace cpslam
