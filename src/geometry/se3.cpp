#include "geometry/se3.h"

#include <cmath>

namespace cpslam {
namespace {

// Below this angle the closed forms lose digits and their Taylor series are exact to double precision.
constexpr double kSmallAngle = 1e-4;

/// 1 - cos without its cancellation at small angles.
double one_minus_cos(double angle) {
  const double sine = std::sin(0.5 * angle);
  return 2.0 * sine * sine;
}

/// Left Jacobian of SO(3), the V of exp([v, w]) = (Exp(w), V v).
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const Eigen::Matrix3d hat = skew(w);
  double a = 0.5 - angle * angle / 24.0;         // (1 - cos) / angle^2
  double b = 1.0 / 6.0 - angle * angle / 120.0;  // (angle - sin) / angle^3
  if (angle > kSmallAngle) {
    a = one_minus_cos(angle) / (angle * angle);
    b = (angle - std::sin(angle)) / (angle * angle * angle);
  }
  return Eigen::Matrix3d::Identity() + a * hat + b * hat * hat;
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

Eigen::Matrix3d so3_exp(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  const Eigen::Matrix3d hat = skew(rotation_vector);
  double a = 1.0 - angle * angle / 6.0;   // sin / angle
  double b = 0.5 - angle * angle / 24.0;  // (1 - cos) / angle^2
  if (angle > kSmallAngle) {
    a = std::sin(angle) / angle;
    b = one_minus_cos(angle) / (angle * angle);
  }
  return Eigen::Matrix3d::Identity() + a * hat + b * hat * hat;
}

Eigen::Vector3d so3_log(const Eigen::Matrix3d& rotation) {
  // Through the quaternion: well conditioned near pi as well, where the skew part of the matrix vanishes.
  Eigen::Quaterniond q(rotation);
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine < 0.5 * kSmallAngle) return 2.0 * q.vec() * (1.0 + sine * sine / 6.0);
  return 2.0 * std::atan2(sine, q.w()) / sine * q.vec();
}

double rotation_angle(const Eigen::Matrix3d& rotation) {
  return so3_log(rotation).norm();
}

SE3 SE3::exp(const Eigen::Matrix<double, 6, 1>& twist) {
  const Eigen::Vector3d w = twist.tail<3>();
  return {so3_exp(w), left_jacobian(w) * twist.head<3>()};
}

Eigen::Matrix<double, 6, 1> SE3::log() const {
  Eigen::Matrix<double, 6, 1> twist;
  twist.tail<3>() = so3_log(rotation);
  twist.head<3>() = left_jacobian(twist.tail<3>()).lu().solve(translation);
  return twist;
}

Pose to_pose(const SE3& transform) {
  const Eigen::Quaterniond q = transform.quaternion();
  const Eigen::Vector3d& t = transform.translation;
  return {{q.x(), q.y(), q.z(), q.w()}, {t.x(), t.y(), t.z()}};
}

SE3 from_pose(const Pose& pose) {
  const auto& [x, y, z, w] = pose.rotation_xyzw;
  const auto& t = pose.translation_m;
  return {Eigen::Quaterniond(w, x, y, z).normalized(), Eigen::Vector3d(t[0], t[1], t[2])};
}

}  // namespace cpslam
