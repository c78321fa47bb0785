// Several maps in one Map, and how a loop makes one of two.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/map_file.h"
#include "map/map_monkey.h"
#include "map/same_parts.h"

namespace cpslam {
namespace {

using test::blank_features;
using test::share_points;
using testing::ElementsAre;

SE3 pose(double x, double angle_rad) {
  return {so3_exp({0.1, angle_rad, -0.2}), {x, 0.2, 0.3}};
}

/// A session of keyframes in a row, each the child of the one before.
std::vector<KeyFrameId> add_session(Map& map, int session, int n) {
  std::vector<KeyFrameId> ids;
  for (int i = 0; i < n; ++i) {
    KeyFrame keyframe;
    keyframe.features = blank_features(60);
    keyframe.cam_from_world = pose(i, 0.1 * i + session);
    keyframe.session = session;
    ids.push_back(map.add_keyframe(std::move(keyframe)));
    if (i > 0) share_points(map, ids[ids.size() - 2], ids.back(), 20);
    map.update_covisibility(ids.back());
  }
  return ids;
}

struct TwoSessions {
  Map map{synthetic::pyramid()};
  std::vector<KeyFrameId> old = add_session(map, 1, 4);
  std::vector<KeyFrameId> young = add_session(map, 2, 5);
};

/// Where every keyframe has each of its points.
std::vector<Eigen::Vector3d> points_before_cameras(const Map& map, const std::vector<KeyFrameId>& ids) {
  std::vector<Eigen::Vector3d> points;
  for (const KeyFrameId id : ids) {
    for (const MapPointId point : map.keyframe(id)->points) {
      if (point.valid())
        points.push_back(map.keyframe(id)->cam_from_world * map.point(point)->position_in_world);
    }
  }
  return points;
}

TEST(Sessions, TheFirstKeyframeOfEachIsItsRoot) {
  TwoSessions two;
  EXPECT_THAT(two.map.sessions(), ElementsAre(1, 2));
  EXPECT_EQ(two.map.sessions_created(), 2);
  for (const auto* ids : {&two.old, &two.young}) {
    EXPECT_TRUE(two.map.is_root(ids->front()));
    EXPECT_FALSE(two.map.is_root((*ids)[1]));
    EXPECT_FALSE(two.map.erase_keyframe(ids->front()));
    two.map.update_covisibility(ids->front());
    EXPECT_FALSE(two.map.keyframe(ids->front())->parent.valid());
  }
  ASSERT_TRUE(two.map.erase_keyframe(two.young[2]));
  EXPECT_EQ(two.map.session_of(two.young[2]), 2) << "culled, and still of its session";
  EXPECT_EQ(two.map.session_of(two.old[3]), 1);
  EXPECT_EQ(two.map.session_of({}), 0);
}

class JoinedSessions : public testing::TestWithParam<bool> {};

TEST_P(JoinedSessions, TheYoungerMovesIntoTheOldersWorld) {
  TwoSessions two;
  Map& map = two.map;
  ASSERT_TRUE(map.erase_keyframe(two.young[1]));
  const SE3 culled_from_root =
      *map.cam_from_world(two.young[1]) * map.keyframe(two.young[0])->cam_from_world.inverse();
  const SE3 old_pose = map.keyframe(two.old[2])->cam_from_world;
  const auto living = std::vector{two.young[0], two.young[2], two.young[3], two.young[4]};
  const auto before = points_before_cameras(map, living);
  const SE3 young_from_old = pose(0.3, 0.5);
  const int gone = GetParam() ? map.join_sessions(two.young[3], two.old[2], young_from_old)
                              : map.join_sessions(two.old[2], two.young[3], young_from_old.inverse());
  EXPECT_EQ(gone, 2) << "whichever comes first";
  EXPECT_THAT(map.sessions(), ElementsAre(1));
  EXPECT_EQ(map.sessions_created(), 2) << "the number is not used again";
  EXPECT_EQ(map.keyframe(two.old[2])->cam_from_world.translation, old_pose.translation);
  for (const KeyFrameId id : two.young) EXPECT_EQ(map.session_of(id), 1);
  EXPECT_LT(synthetic::distance(map.keyframe(two.young[3])->cam_from_world, young_from_old * old_pose), 1e-9);
  const auto after = points_before_cameras(map, living);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LT((after[i] - before[i]).norm(), 1e-9);
  EXPECT_LT(synthetic::distance(
                *map.cam_from_world(two.young[1]) * map.keyframe(two.young[0])->cam_from_world.inverse(),
                culled_from_root),
            1e-9)
      << "what hangs on a culled keyframe comes along";
  EXPECT_EQ(map.keyframe(two.young[3])->parent, two.old[2]);
  test::check_tree(map, two.old[0], true);
  test::check_links(map);
  EXPECT_FALSE(map.is_root(two.young[0]));
}

INSTANTIATE_TEST_SUITE_P(EitherEndFirst, JoinedSessions, testing::Bool());

TEST(Sessions, NormalsTurnWithTheirSession) {
  TwoSessions two;
  const MapPointId point = two.map.keyframe(two.young[1])->points[0];
  two.map.refresh_point(point);
  const Eigen::Matrix3d to_camera = two.map.keyframe(two.young[1])->cam_from_world.rotation;
  const Eigen::Vector3d seen = to_camera * two.map.point(point)->normal;
  ASSERT_EQ(two.map.join_sessions(two.old[0], two.young[1], pose(0.0, 1.5)), 2);
  const Eigen::Vector3d seen_now =
      two.map.keyframe(two.young[1])->cam_from_world.rotation * two.map.point(point)->normal;
  EXPECT_LT((seen_now - seen).norm(), 1e-9);
}

TEST(Sessions, NothingIsJoinedWithoutTwo) {
  TwoSessions two;
  EXPECT_EQ(two.map.join_sessions(two.old[0], two.old[1], {}), 0);
  ASSERT_TRUE(two.map.erase_keyframe(two.young[4]));
  EXPECT_EQ(two.map.join_sessions(two.old[0], two.young[4], {}), 0);
  EXPECT_EQ(two.map.join_sessions({}, two.young[0], {}), 0);
  EXPECT_THAT(two.map.sessions(), ElementsAre(1, 2));
}

TEST(Sessions, TheThirdKeepsItsNumberAndPlace) {
  TwoSessions two;
  const std::vector<KeyFrameId> third = add_session(two.map, 3, 3);
  const SE3 before = two.map.keyframe(third[2])->cam_from_world;
  ASSERT_EQ(two.map.join_sessions(two.old[1], two.young[1], {}), 2);
  EXPECT_THAT(two.map.sessions(), ElementsAre(1, 3));
  EXPECT_EQ(two.map.keyframe(third[2])->cam_from_world.translation, before.translation);
  ASSERT_EQ(two.map.join_sessions(third[1], two.young[2], {}), 3);
  test::check_tree(two.map, two.old[0], true);
}

TEST(Sessions, EachIsTakenApartAndPutTogetherByItself) {
  TwoSessions two;
  two.map.add_loop_edge(two.young[0], two.young[3]);
  MapFile file;
  file.camera = synthetic::settings().camera;
  file.orb = synthetic::settings().orb;
  for (const int session : two.map.sessions()) file.sessions.push_back(take_apart(two.map, session));
  ASSERT_EQ(file.sessions.size(), 2U);
  EXPECT_EQ(file.sessions[0].keyframes.size(), two.old.size());
  EXPECT_EQ(file.sessions[1].keyframes.front().sequence, two.old.size());
  EXPECT_EQ(file.sessions[1].loops.size(), 1U);
  EXPECT_EQ(file.sessions[0].points.size() + file.sessions[1].points.size(), two.map.n_points());
  const MapFile read = map_from_bytes(to_bytes(file), file.camera, file.orb);
  Map again(synthetic::pyramid());
  std::vector<std::vector<KeyFrameId>> ids;
  for (const MapParts& parts : read.sessions) ids.push_back(again.assemble(parts));
  EXPECT_THAT(again.sessions(), ElementsAre(1, 2));
  EXPECT_EQ(again.keyframes_created(), two.map.keyframes_created());
  EXPECT_TRUE(again.is_root(ids[1][0]));
  test::check_links(again);
  test::check_covisibility(again);
  for (const int session : again.sessions())
    test::expect_same(take_apart(again, session), file.sessions[static_cast<std::size_t>(session) - 1]);
  EXPECT_EQ(again.join_sessions(ids[0][1], ids[1][2], {}), 2);
  test::check_tree(again, ids[0][0], true);
  EXPECT_NO_THROW(check(take_apart(again), 8)) << "what was joined can be saved";
}

}  // namespace
}  // namespace cpslam
