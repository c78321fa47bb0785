#include "viewer/orbit_camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace cpslam::viewer {
namespace {

constexpr double kFieldOfViewRad = 0.8;  // from top to bottom
constexpr double kTurnRadPerPx = 0.006;
constexpr double kZoomPerNotch = 0.88;
constexpr double kNearestM = 0.05;
constexpr double kFarthestM = 2000.0;
constexpr double kSteepestRad = 1.55;  // short of straight down, where right and left are lost

/// The world's axis that lies flattest under this up.
Eigen::Vector3d forward_under(const Eigen::Vector3d& up) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d axis = std::abs(up.dot(z)) < 0.9 ? z : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  return (axis - axis.dot(up) * up).normalized();
}

}  // namespace

void OrbitCamera::set_up(const Eigen::Vector3d& up) {
  up_ = up.normalized();
}

void OrbitCamera::set_distance(double distance_m) {
  distance_m_ = std::clamp(distance_m, kNearestM, kFarthestM);
}

void OrbitCamera::set_angles(double yaw_rad, double pitch_rad) {
  yaw_rad_ = yaw_rad;
  pitch_rad_ = std::clamp(pitch_rad, -kSteepestRad, kSteepestRad);
}

void OrbitCamera::turn(double dx_px, double dy_px) {
  // The map follows the mouse.
  set_angles(yaw_rad_ + kTurnRadPerPx * dx_px, pitch_rad_ + kTurnRadPerPx * dy_px);
}

void OrbitCamera::pan(double dx_px, double dy_px, double height_px) {
  const double m_per_px = distance_m_ / focal_px(height_px);
  const Eigen::Matrix3d a = axes();
  target_ += m_per_px * (-dx_px * a.col(0) + dy_px * a.col(1));
}

void OrbitCamera::zoom(double notches) {
  set_distance(distance_m_ * std::pow(kZoomPerNotch, notches));
}

Eigen::Matrix3d OrbitCamera::axes() const {
  const Eigen::Vector3d ahead = Eigen::AngleAxisd(-yaw_rad_, up_) * forward_under(up_);
  const Eigen::Vector3d right = ahead.cross(up_);
  const Eigen::Vector3d looking = std::cos(pitch_rad_) * ahead - std::sin(pitch_rad_) * up_;
  Eigen::Matrix3d result;
  result << right, right.cross(looking), -looking;
  return result;
}

Eigen::Vector3d OrbitCamera::eye() const {
  return target_ + distance_m_ * axes().col(2);
}

Eigen::Matrix4f OrbitCamera::eye_from_world() const {
  const Eigen::Matrix3d rotation = axes().transpose();
  Eigen::Matrix4d result = Eigen::Matrix4d::Identity();
  result.topLeftCorner<3, 3>() = rotation;
  result.topRightCorner<3, 1>() = -(rotation * eye());
  return result.cast<float>();
}

Eigen::Matrix4f OrbitCamera::clip_from_eye(double aspect) const {
  const double near_m = 0.02 * distance_m_;
  const double far_m = distance_m_ * 50.0 + 100.0;
  const double scale = 1.0 / std::tan(0.5 * kFieldOfViewRad);
  Eigen::Matrix4d result = Eigen::Matrix4d::Zero();
  result(0, 0) = scale / aspect;
  result(1, 1) = scale;
  result(2, 2) = -(far_m + near_m) / (far_m - near_m);
  result(2, 3) = -2.0 * far_m * near_m / (far_m - near_m);
  result(3, 2) = -1.0;
  return result.cast<float>();
}

double OrbitCamera::distance_to_see(double radius_m, double aspect) {
  const double half = std::atan(std::tan(0.5 * kFieldOfViewRad) * std::min(1.0, aspect));
  return radius_m / std::sin(half);
}

double OrbitCamera::focal_px(double height_px) {
  return 0.5 * height_px / std::tan(0.5 * kFieldOfViewRad);
}

}  // namespace cpslam::viewer
