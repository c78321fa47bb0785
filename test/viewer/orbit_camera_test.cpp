#include "viewer/orbit_camera.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

namespace cpslam::viewer {
namespace {

constexpr double kAspect = 1.5;
constexpr double kHeightPx = 900.0;

/// Where a point of the world is in the view: x to the right and y upwards in [-1, 1], z the depth.
Eigen::Vector3d in_view(const OrbitCamera& eye, const Eigen::Vector3d& point) {
  const Eigen::Vector4f clip = eye.clip_from_eye(kAspect) * eye.eye_from_world() *
                               Eigen::Vector4f(float(point.x()), float(point.y()), float(point.z()), 1.0F);
  return (clip.head<3>() / clip.w()).cast<double>();
}

TEST(OrbitCamera, TheTargetIsInTheMiddleFromEverywhere) {
  OrbitCamera eye;
  const Eigen::Vector3d target(1.0, -2.0, 3.0);
  eye.set_target(target);
  for (const double yaw : {0.0, 1.0, 4.0}) {
    for (const double pitch : {-0.8, 0.0, 0.7, 1.5}) {
      eye.set_angles(yaw, pitch);
      const Eigen::Vector3d middle = in_view(eye, target);
      EXPECT_NEAR(middle.x(), 0.0, 1e-5);
      EXPECT_NEAR(middle.y(), 0.0, 1e-5);
      EXPECT_GT(middle.z(), -1.0);
      EXPECT_LT(middle.z(), 1.0);
      EXPECT_NEAR((eye.eye() - target).norm(), eye.distance_m(), 1e-9);
    }
  }
}

TEST(OrbitCamera, LooksAlongTheFirstCameraWithItsUpUpwards) {
  OrbitCamera eye;
  eye.set_angles(0.0, 0.0);
  eye.set_distance(4.0);
  EXPECT_TRUE(eye.eye().isApprox(Eigen::Vector3d(0.0, 0.0, -4.0), 1e-9)) << "behind the target, forward is z";
  EXPECT_GT(in_view(eye, {0.5, 0.0, 0.0}).x(), 0.05) << "x is to the right";
  EXPECT_LT(in_view(eye, {0.0, 0.5, 0.0}).y(), -0.05) << "y is down";
  EXPECT_GT(in_view(eye, {0.0, 0.0, 1.0}).z(), in_view(eye, {0.0, 0.0, 0.0}).z()) << "farther is deeper";
}

TEST(OrbitCamera, PitchedItLooksFromAbove) {
  OrbitCamera eye;
  eye.set_angles(0.0, 0.7);
  EXPECT_LT(eye.eye().y(), -1.0) << "y is down";
  eye.set_angles(0.0, 20.0);
  EXPECT_GT(eye.eye().norm(), 0.0);
  EXPECT_TRUE(eye.eye_from_world().allFinite());
  EXPECT_LT(eye.eye().y(), -0.99 * eye.distance_m());
}

TEST(OrbitCamera, AnyUpWillDo) {
  OrbitCamera eye;
  for (const Eigen::Vector3d& up :
       {Eigen::Vector3d(0, 0, 3), Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(0, -1, 0.1)}) {
    eye.set_up(up);
    const Eigen::Matrix3f rotation = eye.eye_from_world().topLeftCorner<3, 3>();
    EXPECT_TRUE((rotation * rotation.transpose()).isIdentity(1e-5F));
    EXPECT_NEAR(rotation.determinant(), 1.0F, 1e-5F);
    EXPECT_GT(in_view(eye, eye.target() + 0.5 * up.normalized()).y(), 0.0);
  }
}

TEST(OrbitCamera, PanningKeepsTheMapUnderTheMouse) {
  OrbitCamera eye;
  eye.set_target({0.3, 0.2, 0.1});
  const Eigen::Vector3d before = eye.target();
  eye.pan(120.0, -45.0, kHeightPx);
  const Eigen::Vector3d moved = in_view(eye, before);
  EXPECT_NEAR(moved.x() * 0.5 * kAspect * kHeightPx, 120.0, 0.01);
  EXPECT_NEAR(moved.y() * 0.5 * kHeightPx, 45.0, 0.01) << "the mouse counts downwards";
}

TEST(OrbitCamera, TurningMovesWhatIsInFrontWithTheMouse) {
  OrbitCamera eye;
  eye.set_angles(0.0, 0.3);
  const Eigen::Vector3d in_front = eye.target() + 0.3 * (eye.eye() - eye.target());
  const Eigen::Vector3d before = in_view(eye, in_front);
  eye.turn(50.0, 0.0);
  EXPECT_GT(in_view(eye, in_front).x(), before.x() + 0.01);
  eye.turn(-50.0, 50.0);
  EXPECT_LT(in_view(eye, in_front).y(), before.y() - 0.01);
}

TEST(OrbitCamera, ZoomIsBounded) {
  OrbitCamera eye;
  const double before = eye.distance_m();
  eye.zoom(1.0);
  EXPECT_LT(eye.distance_m(), before);
  eye.zoom(-1.0);
  EXPECT_NEAR(eye.distance_m(), before, 1e-9);
  eye.zoom(1e6);
  EXPECT_GT(eye.distance_m(), 0.0);
  eye.zoom(-1e6);
  EXPECT_TRUE(eye.clip_from_eye(kAspect).allFinite());
}

TEST(OrbitCamera, ABallFillsTheViewFromItsDistance) {
  OrbitCamera eye;
  eye.set_angles(0.0, 0.0);
  for (const double aspect : {1.5, 0.6}) {
    eye.set_distance(OrbitCamera::distance_to_see(2.0, aspect));
    // The ray that touches the ball is at right angles to the radius there.
    const double d = eye.distance_m();
    const double along = 4.0 / d;
    const double across = std::sqrt(4.0 - along * along);
    const Eigen::Vector3d touched =
        aspect > 1.0 ? Eigen::Vector3d(0.0, -across, -along) : Eigen::Vector3d(across, 0.0, -along);
    const Eigen::Vector4f clip =
        eye.clip_from_eye(aspect) * eye.eye_from_world() *
        Eigen::Vector4f(float(touched.x()), float(touched.y()), float(touched.z()), 1.0F);
    EXPECT_NEAR(aspect > 1.0 ? clip.y() / clip.w() : clip.x() / clip.w(), 1.0F, 1e-4F);
  }
}

}  // namespace
}  // namespace cpslam::viewer
