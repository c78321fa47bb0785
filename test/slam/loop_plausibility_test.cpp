#include "slam/loop_plausibility.h"

#include <gtest/gtest.h>

#include "map/map_builder.h"
#include "slam/scene.h"

namespace cpslam {
namespace {

using test::add_keyframe;
using test::blank_features;
using test::share_points;

/// n keyframes 1 m apart, each joined to the next.
struct Row {
  explicit Row(int n) {
    for (int i = 0; i < n; ++i) {
      ids.push_back(
          add_keyframe(map, blank_features(100), SE3(Eigen::Matrix3d::Identity(), {-1.0 * i, 0.0, 0.0})));
      if (i > 0) share_points(map, ids[static_cast<std::size_t>(i) - 1], ids.back(), 30);
      map.update_covisibility(ids.back());
    }
  }
  /// The last keyframe measured from the first, off by so much.
  [[nodiscard]] LoopEdge loop(double error_m, double error_rad) const {
    const SE3 as_it_is =
        map.keyframe(ids.back())->cam_from_world * map.keyframe(ids.front())->cam_from_world.inverse();
    return {ids.back(), ids.front(), SE3(so3_exp({0.0, error_rad, 0.0}), {error_m, 0.0, 0.0}) * as_it_is};
  }
  Map map{scene::kRig.pyramid};
  std::vector<KeyFrameId> ids;
};

TEST(ChainLength, IsTheShortestWay) {
  Row row(11);
  EXPECT_NEAR(*chain_length_m(row.map, row.ids[0], row.ids[10]), 10.0, 1e-9);
  EXPECT_NEAR(*chain_length_m(row.map, row.ids[7], row.ids[4]), 3.0, 1e-9);
  EXPECT_EQ(*chain_length_m(row.map, row.ids[7], row.ids[7]), 0.0);
  row.map.set_pose(row.ids[10], SE3(Eigen::Matrix3d::Identity(), {-1.0, 0.0, 0.0}));
  row.map.add_loop_edge(row.ids[1], row.ids[10]);
  EXPECT_NEAR(*chain_length_m(row.map, row.ids[0], row.ids[10]), 1.0, 1e-9) << "loops are short cuts";
}

TEST(ChainLength, TurnsCount) {
  Row row(2);
  row.map.set_pose(row.ids[1], SE3(so3_exp({0.0, 1.0, 0.0}), Eigen::Vector3d::Zero()));
  EXPECT_NEAR(*chain_length_m(row.map, row.ids[0], row.ids[1]), 0.5, 1e-9);
}

TEST(LoopPlausibility, DriftGrowsWithTheWay) {
  const Row near(3);
  const Row far(31);
  EXPECT_TRUE(is_plausible(near.map, near.loop(0.2, 0.05)));
  EXPECT_TRUE(is_plausible(far.map, far.loop(0.2, 0.05)));
  EXPECT_FALSE(is_plausible(near.map, near.loop(1.5, 0.0)));
  EXPECT_TRUE(is_plausible(far.map, far.loop(1.5, 0.0)));
  EXPECT_FALSE(is_plausible(near.map, near.loop(0.0, 0.5)));
  EXPECT_TRUE(is_plausible(far.map, far.loop(0.0, 0.5)));
}

TEST(LoopPlausibility, TheOtherOfTwoIdenticalDesksIsRefused) {
  // 5 m and half a turn away, after a walk of 8 m.
  const Row row(9);
  EXPECT_FALSE(is_plausible(row.map, row.loop(5.0, 3.1)));
  EXPECT_FALSE(is_plausible(row.map, row.loop(5.0, 0.0)));
}

TEST(LoopPlausibility, KeyframesThatAreNotConnectedMayLieAnywhere) {
  Row row(3);
  row.ids.push_back(add_keyframe(row.map, blank_features(50), SE3()));
  EXPECT_FALSE(chain_length_m(row.map, row.ids[0], row.ids[3]));
  EXPECT_TRUE(is_plausible(row.map, row.loop(50.0, 3.0)));
}

}  // namespace
}  // namespace cpslam
