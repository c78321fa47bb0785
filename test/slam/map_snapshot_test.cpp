#include "slam/map_snapshot.h"

#include <gtest/gtest.h>

#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "map/map_builder.h"

namespace cpslam {
namespace {

SE3 at_x(double x) {
  return SE3(Eigen::Matrix3d::Identity(), {-x, 0.0, 0.0});
}

/// Keyframes a, b, c, d along x; a-b share many points, b-c a few, c-d many; a loop from d to a.
class MapSnapshotTest : public testing::Test {
 protected:
  MapSnapshotTest() {
    const std::vector<std::size_t> shared{MapSnapshot::kStrongEdge, MapSnapshot::kStrongEdge - 1,
                                          MapSnapshot::kStrongEdge + 1};
    for (int i = 0; i < 4; ++i) {
      ids.push_back(test::add_keyframe(map, test::blank_features(400), at_x(i)));
      if (i > 0) test::share_points(map, ids.end()[-2], ids.back(), shared[static_cast<std::size_t>(i - 1)]);
      map.update_covisibility(ids.back());
    }
    map.add_loop_edge(ids[3], ids[0]);
  }
  Map map{synthetic::pyramid()};
  std::vector<KeyFrameId> ids;
};

std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs(const std::vector<KeyFrameEdge>& edges) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
  for (const KeyFrameEdge& edge : edges) all.emplace_back(edge.from, edge.to);
  return all;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

TEST_F(MapSnapshotTest, HoldsEveryPointWhereItIs) {
  map.set_position(map.point_ids()[7], {1.0, -2.0, 3.5});
  const MapSnapshot snapshot = copy_for_viewer(map);
  ASSERT_EQ(snapshot.points.size(), map.n_points());
  EXPECT_EQ(snapshot.points[7], (WorldPoint{1.0F, -2.0F, 3.5F}));
}

TEST_F(MapSnapshotTest, HoldsKeyframesByAgeAndEachEdgeOnce) {
  const MapSnapshot snapshot = copy_for_viewer(map);
  ASSERT_EQ(snapshot.keyframes.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(snapshot.keyframes[i].world_from_camera.translation_m[0], static_cast<double>(i));
  }
  EXPECT_EQ(pairs(snapshot.covisibility), (Pairs{{1, 0}, {3, 2}})) << "the weak edge is none";
  EXPECT_EQ(pairs(snapshot.spanning_tree), (Pairs{{1, 0}, {2, 1}, {3, 2}}));
  EXPECT_EQ(pairs(snapshot.loops), (Pairs{{3, 0}}));
}

TEST_F(MapSnapshotTest, EdgesFollowWhenAKeyframeGoes) {
  ASSERT_TRUE(map.erase_keyframe(ids[1]));
  const MapSnapshot snapshot = copy_for_viewer(map);
  ASSERT_EQ(snapshot.keyframes.size(), 3U);
  for (const auto& edges : {snapshot.covisibility, snapshot.spanning_tree, snapshot.loops}) {
    for (const auto& [from, to] : pairs(edges)) {
      EXPECT_LT(from, 3U);
      EXPECT_LT(to, 3U);
    }
  }
  EXPECT_EQ(pairs(snapshot.loops), (Pairs{{2, 0}}));
  EXPECT_EQ(pairs(snapshot.covisibility), (Pairs{{2, 1}}));
}

TEST(MapSnapshot, IsOneStateOfAMapThatIsWrittenTo) {
  constexpr std::size_t kPerKeyFrame = 50;
  Map map{synthetic::pyramid()};
  std::jthread mapper([&map](const std::stop_token& stop) {
    for (int i = 0; i < 200 && !stop.stop_requested(); ++i) {
      const std::unique_lock lock(map.mutex());
      const KeyFrameId keyframe = test::add_keyframe(map, test::blank_features(kPerKeyFrame), at_x(i));
      for (std::size_t k = 0; k < kPerKeyFrame; ++k)
        map.add_point({0.0, 0.0, 2.0}, {keyframe, static_cast<int>(k)});
    }
  });
  MapSnapshot snapshot;
  while (snapshot.keyframes.size() < 200) {
    snapshot = copy_for_viewer(map);
    ASSERT_EQ(snapshot.points.size(), kPerKeyFrame * snapshot.keyframes.size());
  }
}

TEST(MapSnapshot, OfAnEmptyMapIsEmpty) {
  const Map map{synthetic::pyramid()};
  const MapSnapshot snapshot = copy_for_viewer(map);
  EXPECT_TRUE(snapshot.points.empty());
  EXPECT_TRUE(snapshot.keyframes.empty());
  EXPECT_TRUE(snapshot.spanning_tree.empty());
}

}  // namespace
}  // namespace cpslam
