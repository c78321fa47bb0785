#include "viewer/framing.h"

#include <gtest/gtest.h>

#include "viewer/sample_scene.h"

namespace cpslam::viewer {
namespace {

const Eigen::Vector3d kUp(0.0, -1.0, 0.0);

TEST(Framing, NothingHasNoExtent) {
  EXPECT_FALSE(extent_of({}, kUp).has_value());
  EXPECT_EQ(up_of({}), Eigen::Vector3d(0.0, -1.0, 0.0));
}

TEST(Framing, TheRoomIsInsideAndStrayPointsDoNotCount) {
  MapSnapshot map = sample::map(5000, 5);
  for (int i = 0; i < 20; ++i) map.points.push_back({500.0F, 0.0F, 0.0F});
  const Extent extent = extent_of(map, kUp).value();
  EXPECT_NEAR(extent.centre.x(), 0.0, 0.2);
  EXPECT_NEAR(extent.centre.z(), 0.0, 0.2);
  // Nearly to the corners.
  EXPECT_GT(extent.radius_m, 0.8 * 0.5 * Eigen::Vector3d(8.0, 2.6, 6.0).norm());
  EXPECT_LT(extent.radius_m, 1.0 * 0.5 * Eigen::Vector3d(8.0, 2.6, 6.0).norm());
  EXPECT_NEAR(extent.floor_m, -1.4, 0.02);
}

TEST(Framing, TheTrajectoryIsAlwaysInside) {
  MapSnapshot map;
  map.trajectory.push_back({0.0, {}});
  map.trajectory.push_back({1.0, {}});
  map.trajectory.back().world_from_camera.translation_m = {4.0, 0.0, 0.0};
  const Extent extent = extent_of(map, kUp).value();
  EXPECT_TRUE(extent.centre.isApprox(Eigen::Vector3d(2.0, 0.0, 0.0)));
  EXPECT_DOUBLE_EQ(extent.radius_m, 2.0);
}

TEST(Framing, UpIsTheMeanOfTheCameras) {
  MapSnapshot map;
  // Pitched down as much while looking ahead as while looking back.
  const double pitch = 0.4;
  const SE3 ahead(so3_exp({-pitch, 0.0, 0.0}), Eigen::Vector3d::Zero());
  const SE3 back(so3_exp({0.0, std::numbers::pi, 0.0}) * ahead.rotation, Eigen::Vector3d::Zero());
  map.keyframes = {{0.0, to_pose(ahead)}, {1.0, to_pose(back)}};
  EXPECT_TRUE(up_of(map).isApprox(Eigen::Vector3d(0.0, -1.0, 0.0), 1e-9)) << up_of(map).transpose();
}

}  // namespace
}  // namespace cpslam::viewer
