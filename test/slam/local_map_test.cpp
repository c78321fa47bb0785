#include "slam/local_map.h"

#include <gtest/gtest.h>

#include <set>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;
using Kind = PointMatch::Kind;

class LocalMapTest : public testing::Test {
 protected:
  /// A frame at `pose` that is matched to the first `matched` points it sees.
  Frame frame_at(const SE3& pose, std::size_t matched) {
    const synthetic::View view = synthetic::look(mapped.world, pose, {}, random);
    Frame frame = scene::make_frame(view);
    for (std::size_t i = 0; i < frame.matches.size() && i < matched; ++i) {
      const auto p = static_cast<std::size_t>(view.point_of[i]);
      if (mapped.points[p].valid())
        frame.matches[i] = {Kind::kMapPoint, mapped.points[p], mapped.world.points[p]};
    }
    return frame;
  }
  Random random{81};
  scene::MappedWorld mapped{300, scene::row_of_poses(4, 0.1), {}, random};
  LocalMap local;
};

TEST_F(LocalMapTest, GathersEachPointOfTheNeighbourhoodOnce) {
  local.update(mapped.map, frame_at({}, 50));
  std::set<MapPointId> ids;
  for (const PointSnapshot& point : local.points()) EXPECT_TRUE(ids.insert(point.id).second);
  EXPECT_EQ(ids.size(), mapped.map.n_points());
  ASSERT_TRUE(local.reference().valid());
  EXPECT_EQ(local.reference_from_world().translation,
            mapped.map.keyframe(local.reference())->cam_from_world.translation);
}

TEST_F(LocalMapTest, ReferenceSharesMostPoints) {
  // A keyframe far to the side that sees other points than the rest.
  const SE3 aside = synthetic::moved({}, {0.0, 0.0, 0.0}, 0.6);
  const KeyFrameId id = mapped.add_view(aside, {}, random);
  Frame frame = frame_at(aside, 0);
  for (std::size_t i = 0; i < frame.matches.size(); ++i) {
    const MapPointId point = mapped.map.keyframe(id)->points[i];
    if (!point.valid()) continue;
    frame.matches[i] = {Kind::kMapPoint, point, mapped.map.point(point)->position_in_world};
  }
  mapped.map.erase_point(mapped.map.keyframe(mapped.keyframes[0])->points[0]);
  local.update(mapped.map, frame);
  int seen_by_reference = 0;
  int seen_by_id = 0;
  for (const PointMatch& match : frame.matches) {
    if (match.kind != Kind::kMapPoint) continue;
    seen_by_reference += mapped.map.keypoint_of(match.id, local.reference()) >= 0 ? 1 : 0;
    seen_by_id += mapped.map.keypoint_of(match.id, id) >= 0 ? 1 : 0;
  }
  EXPECT_EQ(seen_by_reference, seen_by_id) << "no keyframe shares more than the one the frame repeats";
}

TEST_F(LocalMapTest, CopiesAgainWhenTheMapChanged) {
  const Frame frame = frame_at({}, 50);
  local.update(mapped.map, frame);
  const PointSnapshot* data = local.points().data();
  const MapPointId moved = local.points().front().id;
  local.update(mapped.map, frame);
  EXPECT_EQ(local.points().data(), data);
  mapped.map.set_position(moved, {0.1, 0.2, 0.3});
  EXPECT_NE(local.points().front().position_in_world, Eigen::Vector3d(0.1, 0.2, 0.3)) << "a copy";
  local.update(mapped.map, frame);
  EXPECT_EQ(local.points().front().position_in_world, Eigen::Vector3d(0.1, 0.2, 0.3));
}

TEST_F(LocalMapTest, FrameWithoutMatchesKeepsTheOldCopy) {
  local.centre_on(mapped.map, mapped.keyframes[2]);
  const std::size_t points = local.points().size();
  EXPECT_GT(points, 0U);
  local.update(mapped.map, frame_at({}, 0));
  EXPECT_EQ(local.reference(), mapped.keyframes[2]);
  EXPECT_EQ(local.points().size(), points);
}

TEST_F(LocalMapTest, TrackingFindsWhatTheFrameShows) {
  const SE3 truth = synthetic::moved({}, {0.15, 0.02, 0.0}, -0.02);
  Frame frame = frame_at(truth, 40);
  frame.matches[frame.matches.size() - 1] = {Kind::kTemporary, {}, {0.0, 0.0, 1.0}};
  local.update(mapped.map, frame);
  // A start 3 mm off: 1 px.
  frame.cam_from_world = synthetic::moved(truth, {0.003, 0.0, 0.0});
  const LocalMapMatch match = track_local_map(kRig, local, 1.0F, frame);
  int matched = 0;
  for (const PointMatch& m : frame.matches) {
    EXPECT_NE(m.kind, Kind::kTemporary);
    matched += m.kind == Kind::kMapPoint ? 1 : 0;
  }
  EXPECT_EQ(match.inliers, matched);
  EXPECT_GT(match.inliers, 0.9 * frame.features->size());
  EXPECT_LT(synthetic::distance(frame.cam_from_world, truth), 0.001);
  EXPECT_EQ(std::set<MapPointId>(match.expected.begin(), match.expected.end()).size(), match.expected.size());
  EXPECT_GE(match.expected.size(), static_cast<std::size_t>(match.inliers));
}

}  // namespace
}  // namespace cpslam
