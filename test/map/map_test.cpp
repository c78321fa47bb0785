#include "map/map.h"

#include <gtest/gtest.h>

#include "map/map_builder.h"

namespace cpslam {
namespace {

using test::add_keyframe;
using test::blank_features;
using test::share_points;

TEST(Map, AddKeyFrameStartsWithoutLinks) {
  Map map(synthetic::pyramid());
  KeyFrame given;
  given.features = blank_features(5);
  given.sequence = 77;
  given.time_s = 1.5;
  given.points.resize(9);
  const KeyFrameId first = map.add_keyframe(given);
  const KeyFrameId second = map.add_keyframe(given);
  EXPECT_EQ(map.keyframe(first)->sequence, 0U);
  EXPECT_EQ(map.keyframe(second)->sequence, 1U);
  EXPECT_EQ(map.keyframe(first)->points, std::vector<MapPointId>(5));
  EXPECT_EQ(map.keyframe(first)->time_s, 1.5);
  EXPECT_EQ(map.n_keyframes(), 2U);
  EXPECT_EQ(map.keyframes_created(), 2U);
}

TEST(Map, RootStaysAndSoDoesAKeyFrameWithoutParent) {
  Map map(synthetic::pyramid());
  const KeyFrameId root = add_keyframe(map, blank_features(5));
  const KeyFrameId unlinked = add_keyframe(map, blank_features(5));
  EXPECT_FALSE(map.erase_keyframe(root));
  EXPECT_FALSE(map.erase_keyframe(unlinked));
  EXPECT_FALSE(map.erase_keyframe(KeyFrameId{}));
  EXPECT_EQ(map.n_keyframes(), 2U);
}

TEST(Map, SequenceOrdersKeyFramesEvenWhenSlotsAreUsedAgain) {
  Map map(synthetic::pyramid());
  std::vector<KeyFrameId> ids{add_keyframe(map, blank_features(80))};
  for (std::size_t i = 1; i < 4; ++i) {
    ids.push_back(add_keyframe(map, blank_features(80)));
    share_points(map, ids[i - 1], ids[i], 20);
    map.update_covisibility(ids[i]);
  }
  ASSERT_TRUE(map.erase_keyframe(ids[1]));
  const KeyFrameId late = add_keyframe(map, blank_features(5));
  EXPECT_EQ(late.index, ids[1].index);
  EXPECT_EQ(map.keyframe(late)->sequence, 4U);
  EXPECT_EQ(map.keyframes_by_sequence(), (std::vector<KeyFrameId>{ids[0], ids[2], ids[3], late}));
}

TEST(Map, CulledKeyFrameFreesItsFeatures) {
  Map map(synthetic::pyramid());
  const KeyFrameId root = add_keyframe(map, blank_features(40));
  auto features = blank_features(40);
  const std::weak_ptr<const FrameFeatures> watch = features;
  const KeyFrameId id = add_keyframe(map, std::move(features));
  share_points(map, root, id, 20);
  map.update_covisibility(id);
  ASSERT_FALSE(watch.expired());
  ASSERT_TRUE(map.erase_keyframe(id));
  EXPECT_TRUE(watch.expired());
}

TEST(Map, DestructorFreesAllFeatures) {
  std::vector<std::weak_ptr<const FrameFeatures>> watch;
  {
    Map map(synthetic::pyramid());
    KeyFrameId last;
    for (int i = 0; i < 5; ++i) {
      auto features = blank_features(60);
      watch.push_back(features);
      const KeyFrameId id = add_keyframe(map, std::move(features));
      if (last.valid()) share_points(map, last, id, 20);
      map.update_covisibility(id);
      last = id;
    }
  }
  for (const auto& features : watch) EXPECT_TRUE(features.expired());
}

TEST(Map, CountsReturnToTheRootAlone) {
  Map map(synthetic::pyramid());
  std::vector<KeyFrameId> ids{add_keyframe(map, blank_features(100))};
  for (std::size_t i = 1; i < 8; ++i) {
    ids.push_back(add_keyframe(map, blank_features(100)));
    share_points(map, ids[i - 1], ids[i], 20);
    map.update_covisibility(ids[i]);
  }
  EXPECT_EQ(map.n_points(), 7U * 20U);
  for (std::size_t i = 1; i < 8; ++i) EXPECT_TRUE(map.erase_keyframe(ids[i]));
  EXPECT_EQ(map.n_keyframes(), 1U);
  EXPECT_EQ(map.n_points(), 20U) << "the root's points stand on their own depth";
  for (const MapPointId point : std::vector<MapPointId>(map.keyframe(ids[0])->points)) map.erase_point(point);
  EXPECT_EQ(map.n_points(), 0U);
  EXPECT_EQ(map.keyframe(ids[0])->points, std::vector<MapPointId>(100));
  EXPECT_TRUE(map.keyframe(ids[0])->children.empty());
  EXPECT_TRUE(map.keyframe(ids[0])->covisible.empty());
  EXPECT_EQ(map.keyframes_created(), 8U);
  EXPECT_EQ(map.points_created(), 7U * 20U);
}

TEST(Map, VersionGrowsWithEveryChangeAndOnlyThen) {
  Map map(synthetic::pyramid());
  std::uint64_t version = map.version();
  const auto expect_change = [&](bool change, const char* what) {
    EXPECT_EQ(map.version() > version, change) << what;
    version = map.version();
  };
  const KeyFrameId root = add_keyframe(map, blank_features(40));
  expect_change(true, "add_keyframe");
  const KeyFrameId id = add_keyframe(map, blank_features(40));
  const auto points = share_points(map, root, id, 3);
  map.update_covisibility(id);
  version = map.version();
  map.set_pose(id, SE3(Eigen::Matrix3d::Identity(), {0.1, 0.0, 0.0}));
  expect_change(true, "set_pose");
  map.set_position(points[0], {0.0, 0.0, 1.0});
  expect_change(true, "set_position");
  map.erase_observation(points[0], root);
  expect_change(true, "erase_observation");
  map.add_observation(points[0], {root, 30});
  expect_change(true, "add_observation");
  map.erase_point(points[0]);
  expect_change(true, "erase_point");
  map.erase_keyframe(id);
  expect_change(true, "erase_keyframe");
  map.set_pose(id, {});
  map.erase_keyframe(id);
  map.erase_point(points[0]);
  map.set_position(points[0], {});
  map.erase_observation(points[1], id);
  expect_change(false, "what is gone does not change");
}

}  // namespace
}  // namespace cpslam
