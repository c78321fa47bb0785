#include "dense/dense_views.h"

#include <gtest/gtest.h>

#include "dense/flat_scene.h"
#include "map/map_builder.h"

namespace cpslam {
namespace {

constexpr std::size_t kViewBytes = 320U * 240U * 5U;

class DenseViewsTest : public testing::Test {
 protected:
  /// A keyframe at x metres, the child of the one before, and its view: a wall at `wall_m`.
  KeyFrameId add(DenseViews& views, double x_m, double wall_m = 2.0, const SE3& view_from_keyframe = {}) {
    const KeyFrameId id = test::add_keyframe(map_, test::blank_features(60),
                                             SE3(Eigen::Matrix3d::Identity(), {-x_m, 0.0, 0.0}));
    if (last_.valid()) test::share_points(map_, last_, id, 20);
    map_.update_covisibility(id);
    last_ = id;
    views.add(id, flat::look(camera_, {flat::wall(wall_m)}), view_from_keyframe, map_);
    return id;
  }
  /// Depth of the walls of those that are left.
  [[nodiscard]] std::vector<int> walls(const DenseViews& views) const {
    std::vector<int> depths;
    for (const PlacedView& placed : views.place(map_)) depths.push_back(placed.view->depth(100, 100));
    return depths;
  }

  Map map_{synthetic::pyramid()};
  PinholeCamera camera_ = flat::camera();
  KeyFrameId last_;
};

TEST_F(DenseViewsTest, ViewsAreWhereTheirKeyframesEndUp) {
  DenseViews views(camera_, 100 * kViewBytes, Log{});
  const SE3 depth_camera(so3_exp({0.0, 0.1, 0.0}), {0.01, 0.0, 0.0});
  const KeyFrameId a = add(views, 0.0);
  const KeyFrameId b = add(views, 1.0, 2.0, depth_camera);
  const SE3 corrected(so3_exp({0.1, 0.2, 0.3}), {4.0, 5.0, 6.0});
  map_.set_pose(b, corrected);
  const std::vector<PlacedView> placed = views.place(map_);
  ASSERT_EQ(placed.size(), 2U);
  EXPECT_LT(synthetic::distance(placed[0].world_from_view.inverse(), *map_.cam_from_world(a)), 1e-9);
  EXPECT_LT(synthetic::distance(placed[1].world_from_view.inverse(), depth_camera * corrected), 1e-9);
}

TEST_F(DenseViewsTest, ACulledKeyframesViewFollowsItsAncestor) {
  DenseViews views(camera_, 100 * kViewBytes, Log{});
  const KeyFrameId a = add(views, 0.0);
  const KeyFrameId b = add(views, 1.0);
  add(views, 2.0);
  ASSERT_TRUE(map_.erase_keyframe(b));
  const SE3 shift(Eigen::Matrix3d::Identity(), {0.0, 0.5, 0.0});
  map_.set_pose(a, shift * *map_.cam_from_world(a));
  const std::vector<PlacedView> placed = views.place(map_);
  ASSERT_EQ(placed.size(), 3U);
  EXPECT_LT((placed[1].world_from_view.translation - Eigen::Vector3d(1.0, -0.5, 0.0)).norm(), 1e-9);
}

TEST_F(DenseViewsTest, WhenMemoryIsFullCulledOnesGoFirstThenThoseNearestToOthers) {
  DenseViews views(camera_, 4 * kViewBytes, Log{});
  add(views, 0.0, 1.0);
  add(views, 1.0, 1.1);
  const KeyFrameId culled = add(views, 5.0, 1.2);
  add(views, 6.0, 1.3);
  EXPECT_EQ(views.n_dropped(), 0U);
  ASSERT_TRUE(map_.erase_keyframe(culled));
  add(views, 6.1, 1.4);
  EXPECT_EQ(walls(views), (std::vector<int>{5000, 5500, 6500, 7000}));
  add(views, 9.0, 1.5);
  EXPECT_EQ(walls(views), (std::vector<int>{5000, 5500, 6500, 7500})) << "6.1 m is next to 6 m";
  EXPECT_EQ(views.n_dropped(), 2U);
  EXPECT_EQ(views.size(), 4U);
}

TEST_F(DenseViewsTest, AtLeastTheLatestIsKept) {
  DenseViews views(camera_, 1, Log{});
  for (int i = 0; i < 4; ++i) add(views, i);
  EXPECT_EQ(views.size(), 1U);
}

}  // namespace
}  // namespace cpslam
