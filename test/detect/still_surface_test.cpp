#include "detect/still_surface.h"

#include <gtest/gtest.h>

#include "detect/depth_scene.h"

namespace cpslam {
namespace {

using scene::DepthScene;
using scene::View;

constexpr int kFar = 5 * 160 + 20;  // a cell at the image's upper border, on the wall

TEST(StillSurface, AgesWhereNothingMoves) {
  const GridCamera camera = scene::grid_camera();
  const DepthScene room = DepthScene().wall(3.5F).floor().block({-1.0F, 0.4F, 2.0F}, {0.0F, 1.2F, 2.6F});
  Random random(1);
  View view = room.look(camera);
  StillSurface still = StillSurface::begin(view.depth_m);
  EXPECT_LT(still.age(kFar), StillSurface::kStillAge);
  constexpr int kFrames = 30;
  for (int i = 0; i < kFrames; ++i) {
    View noisy = room.look(camera);
    scene::add_noise(noisy, random);
    still = still.carry(camera, noisy.depth_m, SE3());
  }
  const double old = double(cv::countNonZero(still.age >= kFrames));
  EXPECT_GT(old, 0.97 * double(still.age.total()));
}

TEST(StillSurface, NeverGrowsOlderThanItsLimit) {
  const GridCamera camera = scene::grid_camera();
  const cv::Mat1f wall_m(camera.size(), 2.0F);
  StillSurface still = StillSurface::begin(wall_m);
  for (int i = 0; i < 400; ++i) still = still.carry(camera, wall_m, SE3());
  EXPECT_EQ(cv::countNonZero(still.age == 250), camera.n_cells());
}

TEST(StillSurface, WhatArrivesHasStoodForNoTime) {
  const GridCamera camera = scene::grid_camera();
  const cv::Mat1f wall_m(camera.size(), 3.0F);
  StillSurface still = StillSurface::begin(wall_m);
  for (int i = 0; i < 20; ++i) still = still.carry(camera, wall_m, SE3());
  cv::Mat1f next_m = wall_m.clone();
  const cv::Rect come(50, 40, 20, 30);
  next_m(come).setTo(2.0F);
  still = still.carry(camera, next_m, SE3());
  EXPECT_EQ(cv::countNonZero(still.age(come)), 0);
  EXPECT_GE(still.age(20, 20), StillSurface::kStillAge);
}

TEST(StillSurface, WhatIsUncoveredIsUnknown) {
  const GridCamera camera = scene::grid_camera();
  cv::Mat1f first_m(camera.size(), 3.0F);
  const cv::Rect leaves(50, 40, 20, 30);
  first_m(leaves).setTo(2.0F);
  StillSurface still = StillSurface::begin(first_m);
  for (int i = 0; i < 20; ++i) still = still.carry(camera, first_m, SE3());
  still = still.carry(camera, cv::Mat1f(camera.size(), 3.0F), SE3());
  // Not at the rim, where cells see now one, now the other side.
  const cv::Rect inside(leaves.x + 1, leaves.y + 1, leaves.width - 2, leaves.height - 2);
  EXPECT_EQ(cv::countNonZero(still.age(inside) == StillSurface::kUnknownAge), inside.area());
  EXPECT_LT(StillSurface::kUnknownAge, StillSurface::kStillAge);
  EXPECT_EQ(cv::countNonZero(still.changed(inside)), inside.area());
  EXPECT_EQ(still.changed(20, 20), 0) << "the wall beside";
}

TEST(StillSurface, WhatTheCameraTurnsToHasNotChanged) {
  const GridCamera camera = scene::grid_camera();
  const DepthScene room = DepthScene().wall(3.5F);
  StillSurface still = StillSurface::begin(room.look(camera).depth_m);
  SE3 last;
  for (int i = 1; i <= 10; ++i) {
    const SE3 next = scene::world_from_camera_at(0.03 * i, 0.0, 0.0);
    still = still.carry(camera, room.look(camera, next).depth_m, next.inverse() * last);
    last = next;
  }
  EXPECT_GT(cv::countNonZero(still.age < 2 + StillSurface::kUnknownAge), 100) << "came into view";
  EXPECT_EQ(cv::countNonZero(still.changed), 0);
}

TEST(StillSurface, WhatBelongsToSomebodyIsNoBackground) {
  const GridCamera camera = scene::grid_camera();
  const cv::Mat1f wall_m(camera.size(), 3.0F);
  cv::Mat1b people(camera.size(), std::uint8_t{0});
  const cv::Rect his(50, 40, 20, 30);
  people(his).setTo(4);
  StillSurface still = StillSurface::begin(wall_m);
  for (int i = 0; i < 20; ++i) {
    still = still.carry(camera, wall_m, SE3());
    still.claim(people);
  }
  EXPECT_EQ(cv::countNonZero(still.free_age(his) >= StillSurface::kStillAge), 0);
  EXPECT_EQ(cv::countNonZero(still.free_age >= StillSurface::kStillAge), camera.n_cells() - his.area());
  EXPECT_EQ(cv::countNonZero(still.age >= StillSurface::kStillAge), camera.n_cells());
  // When he is not followed any more, what stands there is background after a while.
  for (int i = 0; i < 20; ++i) still = still.carry(camera, wall_m, SE3());
  EXPECT_EQ(cv::countNonZero(still.free_age >= StillSurface::kStillAge), camera.n_cells());
}

TEST(StillSurface, AReadingThatDropsOutForgetsNothing) {
  const GridCamera camera = scene::grid_camera();
  const cv::Mat1f wall_m(camera.size(), 3.0F);
  StillSurface still = StillSurface::begin(wall_m);
  for (int i = 0; i < 20; ++i) still = still.carry(camera, wall_m, SE3());
  const int before = still.age(kFar);
  still = still.carry(camera, cv::Mat1f(camera.size(), 0.0F), SE3());
  still = still.carry(camera, wall_m, SE3());
  EXPECT_GE(still.age(kFar), before);
}

TEST(StillSurface, WhoWalksPastDoesNotStandStill) {
  const GridCamera camera = scene::grid_camera();
  scene::Person walker;
  walker.feet = {-2.2F, scene::kCameraHeightM, 2.8F};
  walker.velocity_m_per_s = {1.0F, 0.0F, 0.0F};
  const DepthScene room = DepthScene().wall(4.5F).floor().person(walker);
  StillSurface still = StillSurface::begin(room.look(camera).depth_m);
  for (int i = 1; i <= 100; ++i) {
    const View view = room.look(camera, SE3(), i / 30.0);
    still = still.carry(camera, view.depth_m, SE3());
    const double his = double(cv::countNonZero(view.owner));
    const double called_still =
        double(cv::countNonZero((view.owner != 0) & (still.age >= StillSurface::kStillAge)));
    // His feet come near the floor, which stands still.
    if (his > 300.0) {
      EXPECT_LT(called_still, 0.3 * his) << i;
    }
  }
}

TEST(StillSurface, WhoWalksToTheCameraAndIsKnownDoesNotStandStill) {
  const GridCamera camera = scene::grid_camera();
  scene::Person walker;
  walker.feet = {0.0F, scene::kCameraHeightM, 3.4F};
  walker.velocity_m_per_s = {0.0F, 0.0F, -1.0F};
  const DepthScene room = DepthScene().wall(5.0F).floor().person(walker);
  View view = room.look(camera);
  StillSurface still = StillSurface::begin(view.depth_m);
  for (int i = 1; i <= 60; ++i) {
    still.claim(view.owner);
    view = room.look(camera, SE3(), i / 30.0);
    still = still.carry(camera, view.depth_m, SE3());
    const double his = double(cv::countNonZero(view.owner));
    const double called_still =
        double(cv::countNonZero((view.owner != 0) & (still.free_age >= StillSurface::kStillAge)));
    EXPECT_LT(called_still, 0.05 * his) << i;
  }
}

TEST(StillSurface, FollowsTheCamera) {
  const GridCamera camera = scene::grid_camera();
  const DepthScene room = DepthScene().wall(4.5F).floor().block({-1.0F, 0.4F, 2.5F}, {0.0F, 1.2F, 2.9F});
  const auto pose = [](int i) { return scene::world_from_camera_at(0.005 * i, 0.0, 0.05 * i, 0.006 * i); };
  const View first = room.look(camera, pose(0));
  StillSurface still = StillSurface::begin(first.depth_m);
  StillSurface fooled = still;  // is told that the camera does not move
  for (int i = 1; i <= 25; ++i) {
    const View view = room.look(camera, pose(i));
    still = still.carry(camera, view.depth_m, pose(i).inverse() * pose(i - 1));
    fooled = fooled.carry(camera, view.depth_m, SE3());
  }
  const auto known = [](const StillSurface& s) {
    return double(cv::countNonZero(s.age >= StillSurface::kStillAge)) / double(s.age.total());
  };
  EXPECT_GT(known(still), 0.7);
  EXPECT_LT(known(fooled), 0.5 * known(still));
}

TEST(StillSurface, ReadingsMayBeOffByMoreFartherAway) {
  EXPECT_GT(still_tolerance_m(1.0F), 0.0F);
  EXPECT_GT(still_tolerance_m(5.0F), still_tolerance_m(1.0F));
}

}  // namespace
}  // namespace cpslam
