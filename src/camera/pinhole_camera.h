#pragma once

#include <Eigen/Core>
#include <array>

#include "cpslam/settings.h"

namespace cpslam {

/// Pinhole camera with radial-tangential distortion. Pixels are either *distorted* (as in the image) or
/// *undistorted* (ideal pinhole, the same fx, fy, cx, cy). The camera looks along +z, x right, y down.
/// Immutable, so safe to share between threads.
class PinholeCamera {
 public:
  explicit PinholeCamera(const CameraSettings& settings);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] double fx() const { return fx_; }
  [[nodiscard]] double fy() const { return fy_; }
  [[nodiscard]] double cx() const { return cx_; }
  [[nodiscard]] double cy() const { return cy_; }
  [[nodiscard]] double bf() const { return bf_; }
  [[nodiscard]] bool has_distortion() const { return has_distortion_; }

  /// Undistorted pixel of a point in the camera frame (m); the caller makes sure that z > 0.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& point_in_camera) const {
    const double inverse_z = 1.0 / point_in_camera.z();
    return {fx_ * point_in_camera.x() * inverse_z + cx_, fy_ * point_in_camera.y() * inverse_z + cy_};
  }
  /// Point in the camera frame (m) seen at an undistorted pixel at depth_m along z.
  [[nodiscard]] Eigen::Vector3d back_project(const Eigen::Vector2d& undistorted_px, double depth_m) const {
    return {(undistorted_px.x() - cx_) / fx_ * depth_m, (undistorted_px.y() - cy_) / fy_ * depth_m, depth_m};
  }
  [[nodiscard]] Eigen::Vector2d distort(const Eigen::Vector2d& undistorted_px) const;
  /// Inverse of distort by Newton iteration; accurate to 1e-6 px inside the image.
  [[nodiscard]] Eigen::Vector2d undistort(const Eigen::Vector2d& distorted_px) const;

  /// Smallest box around all undistorted pixels of the image: min x, min y, max x, max y.
  [[nodiscard]] const std::array<double, 4>& undistorted_bounds() const { return bounds_; }
  [[nodiscard]] bool in_image(const Eigen::Vector2d& undistorted_px) const {
    return undistorted_px.x() >= bounds_[0] && undistorted_px.y() >= bounds_[1] &&
           undistorted_px.x() < bounds_[2] && undistorted_px.y() < bounds_[3];
  }

 private:
  int width_, height_;
  double fx_, fy_, cx_, cy_, bf_;
  double k1_, k2_, p1_, p2_, k3_;
  bool has_distortion_;
  std::array<double, 4> bounds_{};
};

}  // namespace cpslam
