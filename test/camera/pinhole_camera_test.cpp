#include "camera/pinhole_camera.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/tum_cameras.h"
#include "util/random.h"

namespace cpslam {
namespace {

CameraSettings plain() {
  CameraSettings s;
  s.fx = 535.4;
  s.fy = 539.2;
  s.cx = 320.1;
  s.cy = 247.6;
  return s;
}

CameraSettings tum2() {
  CameraSettings s;
  s.fx = 520.908620;
  s.fy = 521.007327;
  s.cx = 325.141442;
  s.cy = 249.701764;
  s.k1 = 0.231222;
  s.k2 = -0.784899;
  s.p1 = -0.003257;
  s.p2 = -0.000105;
  s.k3 = 0.917205;
  return s;
}

TEST(PinholeCamera, ProjectsByHand) {
  CameraSettings s;
  s.fx = 500.0;
  s.fy = 400.0;
  s.cx = 320.0;
  s.cy = 240.0;
  s.bf = 40.0;
  const PinholeCamera camera(s);
  EXPECT_TRUE(camera.project({1.0, -0.5, 2.0}).isApprox(Eigen::Vector2d(570.0, 140.0), 1e-15));
  EXPECT_TRUE(camera.back_project({570.0, 140.0}, 2.0).isApprox(Eigen::Vector3d(1.0, -0.5, 2.0), 1e-15));
  EXPECT_FALSE(camera.has_distortion());
  EXPECT_EQ(camera.width(), 640);
  EXPECT_EQ(camera.height(), 480);
}

TEST(PinholeCamera, BackProjectInvertsProject) {
  const PinholeCamera camera(tum1_camera());
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d point(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(0.2, 9.0));
    EXPECT_LT((camera.back_project(camera.project(point), point.z()) - point).norm(), 1e-13);
  }
}

TEST(PinholeCamera, DistortsByHand) {
  CameraSettings s;
  s.fx = s.fy = 100.0;
  s.cx = s.cy = 0.0;
  s.k1 = 0.1;
  s.k2 = 0.01;
  s.k3 = 0.001;
  // At x = 1, y = 0: r = 1, radial factor 1.111.
  EXPECT_TRUE(PinholeCamera(s).distort({100.0, 0.0}).isApprox(Eigen::Vector2d(111.1, 0.0), 1e-14));
  s.p1 = 0.01;
  s.p2 = 0.02;
  // dx = p2 (r^2 + 2 x^2) = 0.06, dy = p1 (r^2 + 2 y^2) = 0.01.
  EXPECT_TRUE(PinholeCamera(s).distort({100.0, 0.0}).isApprox(Eigen::Vector2d(117.1, 1.0), 1e-14));
  // At x = y = 1: r^2 = 2, radial 1 + 0.2 + 0.04 + 0.008 = 1.248;
  // dx = 2 p1 + p2 (2 + 2) = 0.1, dy = p1 (2 + 2) + 2 p2 = 0.08.
  EXPECT_TRUE(PinholeCamera(s).distort({100.0, 100.0}).isApprox(Eigen::Vector2d(134.8, 132.8), 1e-14));
}

TEST(PinholeCamera, WithoutDistortionPixelsStay) {
  const PinholeCamera camera(plain());
  EXPECT_EQ(camera.distort({12.5, 400.0}), Eigen::Vector2d(12.5, 400.0));
  EXPECT_EQ(camera.undistort({12.5, 400.0}), Eigen::Vector2d(12.5, 400.0));
  EXPECT_EQ(camera.undistorted_bounds(), (std::array<double, 4>{0.0, 0.0, 640.0, 480.0}));
  EXPECT_TRUE(camera.in_image({0.0, 0.0}));
  EXPECT_TRUE(camera.in_image({639.99, 479.99}));
  EXPECT_FALSE(camera.in_image({640.0, 10.0}));
  EXPECT_FALSE(camera.in_image({10.0, 480.0}));
  EXPECT_FALSE(camera.in_image({-0.001, 10.0}));
  EXPECT_FALSE(camera.in_image({std::numeric_limits<double>::quiet_NaN(), 10.0}));
}

class RealCalibration : public testing::TestWithParam<CameraSettings> {};

TEST_P(RealCalibration, UndistortInvertsDistortOnTheWholeImage) {
  const PinholeCamera camera(GetParam());
  double worst_px = 0.0;
  double worst_back_px = 0.0;
  for (int y = 0; y <= 480; y += 2) {
    for (int x = 0; x <= 640; x += 2) {
      const Eigen::Vector2d distorted(x, y);
      const Eigen::Vector2d undistorted = camera.undistort(distorted);
      worst_px = std::max(worst_px, (camera.distort(undistorted) - distorted).norm());
      worst_back_px =
          std::max(worst_back_px, (camera.undistort(camera.distort(undistorted)) - undistorted).norm());
    }
  }
  EXPECT_LT(worst_px, 1e-6);
  EXPECT_LT(worst_back_px, 1e-6);
}

TEST_P(RealCalibration, BoundsHoldEveryPixelAndAreTight) {
  const PinholeCamera camera(GetParam());
  std::array<double, 4> seen = {1e9, 1e9, -1e9, -1e9};
  for (int y = 0; y < 480; ++y) {
    // Inside the image nothing reaches further than on the rim, so there every fifth pixel will do.
    const bool rim = y == 0 || y == 479;
    for (int x = 0; x < 640; x += rim || x >= 635 ? 1 : 5) {
      const Eigen::Vector2d u = camera.undistort({x, y});
      EXPECT_TRUE(camera.in_image(u)) << x << " " << y;
      seen = {std::min(seen[0], u.x()), std::min(seen[1], u.y()), std::max(seen[2], u.x()),
              std::max(seen[3], u.y())};
    }
  }
  // The far rims of the last pixels are one pixel further than their coordinates.
  constexpr double kSlackPx = 2.0;
  const std::array<double, 4>& bounds = camera.undistorted_bounds();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(bounds[i], seen[i], kSlackPx) << i;
}

TEST_P(RealCalibration, StaysFiniteFarOutside) {
  const PinholeCamera camera(GetParam());
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector2d far(random.uniform(-3000, 4000), random.uniform(-3000, 4000));
    EXPECT_TRUE(camera.undistort(far).allFinite()) << far.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Tum, RealCalibration, testing::Values(tum1_camera(), tum2()));

}  // namespace
}  // namespace cpslam
