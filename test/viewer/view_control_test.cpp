#include "viewer/view_control.h"

#include <gtest/gtest.h>

#include "viewer/sample_scene.h"

namespace cpslam::viewer {
namespace {

const Eigen::Vector3d kUp(0.0, -1.0, 0.0);

/// Glides until it is there; how many steps that took.
int arrive(ViewControl& view) {
  int steps = 1;
  while (view.glide(0.03) && steps < 1000) ++steps;
  return steps;
}

TEST(ViewControl, TheOverviewHoldsTheMapAtOnceAndAsItGrows) {
  ViewControl view;
  EXPECT_FALSE(view.glide(0.03)) << "there is nothing yet";
  const MapSnapshot small = sample::map(500, 5);
  view.set_map(small);
  EXPECT_FALSE(view.glide(0.03)) << "the first time without a flight";
  EXPECT_TRUE(view.eye().target().isApprox(extent_of(small, up_of(small))->centre));
  MapSnapshot large = small;
  for (WorldPoint& p : large.points) p = {3.0F * p[0] + 5.0F, p[1], 3.0F * p[2]};
  view.set_map(large);
  const double before_m = view.eye().distance_m();
  EXPECT_TRUE(view.glide(0.03));
  EXPECT_GT(arrive(view), 5);
  EXPECT_GT(view.eye().distance_m(), 1.5 * before_m);
  EXPECT_NEAR((view.eye().target() - extent_of(large, up_of(large))->centre).norm(), 0.0, 0.1);
}

TEST(ViewControl, TheOverviewRestsWhileTheMapHardlyGrows) {
  ViewControl view;
  MapSnapshot map = sample::map(500, 5);
  view.set_map(map);
  view.glide(0.03);
  const Eigen::Vector3d eye = view.eye().eye();
  const auto grow = [&map](float factor) {
    for (WorldPoint& p : map.points) p = {factor * p[0], p[1], factor * p[2]};
  };
  grow(1.01F);
  view.set_map(map);
  EXPECT_FALSE(view.glide(0.03));
  EXPECT_LT((view.eye().eye() - eye).norm(), 0.02) << "up may be another one by now";
  for (int i = 0; i < 10; ++i) {
    grow(1.01F);
    view.set_map(map);
  }
  EXPECT_TRUE(view.glide(0.03)) << "many small steps are a large one";
}

TEST(ViewControl, FollowingKeepsWhatTheCameraHasBeforeItInTheMiddleAtTheUsersDistance) {
  ViewControl view;
  view.set_map(sample::map(500, 5));
  view.glide(0.03);
  view.set_mode(ViewMode::kFollow);
  view.set_camera({1.0, 0.0, 2.0}, Eigen::Vector3d::UnitZ());
  arrive(view);
  EXPECT_NEAR((view.eye().target() - Eigen::Vector3d(1.0, 0.0, 3.2)).norm(), 0.0, 0.02);
  view.zoom(5.0);
  const double chosen_m = view.eye().distance_m();
  view.set_camera({2.0, 0.0, 2.0}, Eigen::Vector3d::UnitX());
  arrive(view);
  EXPECT_EQ(view.mode(), ViewMode::kFollow);
  EXPECT_NEAR(view.eye().distance_m(), chosen_m, 0.01 * chosen_m);
  EXPECT_NEAR((view.eye().target() - Eigen::Vector3d(3.2, 0.0, 2.0)).norm(), 0.0, 0.02);
}

TEST(ViewControl, TheUsersHandStopsTheOverview) {
  for (const bool by_wheel : {false, true}) {
    ViewControl view;
    const MapSnapshot map = sample::map(500, 5);
    view.set_map(map);
    view.glide(0.03);
    by_wheel ? view.zoom(2.0) : view.pan(100.0, 0.0, 900.0);
    EXPECT_EQ(view.mode(), ViewMode::kFree);
    const Eigen::Vector3d eye = view.eye().eye();
    EXPECT_FALSE(view.glide(1.0));
    EXPECT_EQ(view.eye().eye(), eye);
    view.reset();
    EXPECT_EQ(view.mode(), ViewMode::kOverview);
    arrive(view);
    EXPECT_NEAR((view.eye().target() - extent_of(map, kUp)->centre).norm(), 0.0, 0.1);
  }
}

TEST(ViewControl, TurningIsNoReasonToStopAnything) {
  ViewControl view;
  view.set_map(sample::map(500, 5));
  view.turn(100.0, 20.0);
  EXPECT_EQ(view.mode(), ViewMode::kOverview);
}

TEST(ViewControl, FromAboveIsFromAbove) {
  ViewControl view;
  view.set_map(sample::map(500, 5));
  view.look_from_above();
  view.glide(0.03);
  const Eigen::Vector3d down = view.eye().target() - view.eye().eye();
  EXPECT_GT(down.y(), 0.99 * down.norm());
}

}  // namespace
}  // namespace cpslam::viewer
