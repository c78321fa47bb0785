#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "cpslam/types.h"

namespace cpslam {

/// A rigid transform x' = rotation * x + translation, named target_from_source where it stands.
struct SE3 {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  SE3() = default;
  SE3(const Eigen::Matrix3d& r, const Eigen::Vector3d& t) : rotation(r), translation(t) {}
  SE3(const Eigen::Quaterniond& q, const Eigen::Vector3d& t)
      : rotation(q.toRotationMatrix()), translation(t) {}

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return rotation * point + translation; }
  SE3 operator*(const SE3& other) const {
    return {rotation * other.rotation, rotation * other.translation + translation};
  }
  [[nodiscard]] SE3 inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
  [[nodiscard]] Eigen::Quaterniond quaternion() const { return Eigen::Quaterniond(rotation).normalized(); }
  /// Rotation matrix pulled back onto SO(3); after long chains of products.
  [[nodiscard]] SE3 normalized() const { return {quaternion(), translation}; }

  /// exp of the twist (translation part v, rotation part w in rad): the group exponential (Barfoot 2017, ch.
  /// 7).
  static SE3 exp(const Eigen::Matrix<double, 6, 1>& twist);
  /// Inverse of exp; the rotation angle lies in [0, pi].
  [[nodiscard]] Eigen::Matrix<double, 6, 1> log() const;
};

[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& v);
[[nodiscard]] Eigen::Matrix3d so3_exp(const Eigen::Vector3d& rotation_vector);
[[nodiscard]] Eigen::Vector3d so3_log(const Eigen::Matrix3d& rotation);

/// Angle of a rotation matrix, rad in [0, pi].
[[nodiscard]] double rotation_angle(const Eigen::Matrix3d& rotation);

[[nodiscard]] Pose to_pose(const SE3& transform);
[[nodiscard]] SE3 from_pose(const Pose& pose);

}  // namespace cpslam
