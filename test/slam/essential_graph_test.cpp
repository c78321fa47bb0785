#include "slam/essential_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "map/map_builder.h"
#include "slam/scene.h"

namespace cpslam {
namespace {

using test::add_keyframe;
using test::blank_features;
using test::share_points;

/// Keyframes 0 to 4 in a row of 1 m steps; each shares 120 points with the one before, 0 and 2 also 120, 1
/// and 3 only 50, and 0 and 3 were once found to be one place.
class EssentialGraphTest : public testing::Test {
 protected:
  EssentialGraphTest() {
    for (int i = 0; i < 5; ++i) {
      ids.push_back(
          add_keyframe(map, blank_features(400), SE3(Eigen::Matrix3d::Identity(), {-1.0 * i, 0.0, 0.0})));
      if (i > 0) share_points(map, ids[static_cast<std::size_t>(i) - 1], ids.back(), 120);
      map.update_covisibility(ids.back());
    }
    share_points(map, ids[0], ids[2], 120);
    share_points(map, ids[1], ids[3], 50);
    for (const KeyFrameId id : ids) map.update_covisibility(id);
    map.add_loop_edge(ids[0], ids[3]);
  }
  static int count(const EssentialGraph& graph, int a, int b) {
    return static_cast<int>(
        std::count_if(graph.graph.edges.begin(), graph.graph.edges.end(),
                      [&](const auto& e) { return (e.a == a && e.b == b) || (e.a == b && e.b == a); }));
  }

  Map map{scene::kRig.pyramid};
  std::vector<KeyFrameId> ids;
};

TEST_F(EssentialGraphTest, HoldsTreeStrongCovisibilityAndLoopsEachOnce) {
  const SE3 measured(Eigen::Matrix3d::Identity(), {0.1, 0.0, 0.0});
  const EssentialGraph graph = essential_graph(map, {ids[4], ids[0], measured});
  EXPECT_EQ(graph.keyframes, ids);
  for (int i = 1; i < 5; ++i) EXPECT_EQ(count(graph, i - 1, i), 1) << "tree edge to " << i;
  EXPECT_EQ(count(graph, 0, 2), 1) << "strong covisibility";
  EXPECT_EQ(count(graph, 1, 3), 0) << "weak covisibility";
  EXPECT_EQ(count(graph, 0, 3), 1) << "an earlier loop";
  EXPECT_EQ(graph.graph.edges.size(), 7U);
  const PoseGraph::Edge& loop = graph.graph.edges.back();
  EXPECT_EQ(loop.a, 0);
  EXPECT_EQ(loop.b, 4);
  EXPECT_EQ(loop.b_from_a.translation, measured.translation);
}

TEST_F(EssentialGraphTest, OnlyTheNewLoopDisagreesWithThePoses) {
  const SE3 as_it_is = map.keyframe(ids[4])->cam_from_world * map.keyframe(ids[0])->cam_from_world.inverse();
  EssentialGraph graph = essential_graph(map, {ids[4], ids[0], as_it_is});
  EXPECT_LT(optimize_pose_graph(graph.graph, {}).initial_cost, 1e-12);
  SE3 shorter = as_it_is;
  shorter.translation.x() += 0.5;
  graph = essential_graph(map, {ids[4], ids[0], shorter});
  optimize_pose_graph(graph.graph, {});
  EXPECT_EQ(graph.graph.cam_from_world[0].translation.x(), 0.0) << "the first keyframe holds the gauge";
  EXPECT_LT(graph.graph.cam_from_world[2].translation.x(), -1.6) << "the error is shared out";
  EXPECT_GT(graph.graph.cam_from_world[2].translation.x(), -2.0);
  EXPECT_GT(graph.graph.cam_from_world[4].translation.x(), -3.9);
}

}  // namespace
}  // namespace cpslam
