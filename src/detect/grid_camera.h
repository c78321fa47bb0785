#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "camera/pinhole_camera.h"
#include "detect/depth_grid.h"
#include "geometry/se3.h"

namespace cpslam {

/// A rigid transform in single precision: enough for cells of a depth grid, and half the work.
struct FloatTransform {
  explicit FloatTransform(const SE3& transform)
      : rotation(transform.rotation.cast<float>()), translation(transform.translation.cast<float>()) {}
  Eigen::Vector3f operator*(const Eigen::Vector3f& p) const { return rotation * p + translation; }
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
};

/// A camera as its depth grid sees it. Cells are numbered in raster order. Immutable, so safe to share.
class GridCamera {
 public:
  explicit GridCamera(const PinholeCamera& camera);

  [[nodiscard]] cv::Size size() const { return size_; }
  [[nodiscard]] int n_cells() const { return size_.area(); }
  [[nodiscard]] cv::Size image_size() const { return {camera_.width(), camera_.height()}; }
  [[nodiscard]] const PinholeCamera& camera() const { return camera_; }

  /// Point in the camera frame (m) at depth_m along the ray through the middle of a cell.
  [[nodiscard]] Eigen::Vector3f point(int cell, float depth_m) const {
    return rays_[static_cast<std::size_t>(cell)] * depth_m;
  }
  /// The cell a point in the camera frame falls into; -1 outside the image or behind the camera.
  [[nodiscard]] int cell_of(const Eigen::Vector3f& point_in_camera) const {
    if (point_in_camera.z() < kNearestM) return -1;
    const float inverse_z = 1.0F / point_in_camera.z();
    const float u = fx_ * point_in_camera.x() * inverse_z + cx_;
    const float v = fy_ * point_in_camera.y() * inverse_z + cy_;
    return camera_.has_distortion() ? cell_of_undistorted(u, v) : cell_of_pixel(u, v);
  }
  /// The cell of a pixel of the image as taken; -1 outside the grid.
  [[nodiscard]] int cell_of_pixel(float x, float y) const {
    // A pixel's area reaches half a pixel around its coordinates.
    const float column = (x + 0.5F) / static_cast<float>(kDepthCellPx);
    const float row = (y + 0.5F) / static_cast<float>(kDepthCellPx);
    if (!(column >= 0.0F) || !(row >= 0.0F) || column >= static_cast<float>(size_.width) ||
        row >= static_cast<float>(size_.height)) {
      return -1;
    }
    return static_cast<int>(row) * size_.width + static_cast<int>(column);
  }

 private:
  static constexpr float kNearestM = 0.1F;
  [[nodiscard]] int cell_of_undistorted(float u, float v) const;

  PinholeCamera camera_;
  cv::Size size_;
  float fx_, fy_, cx_, cy_;
  std::vector<Eigen::Vector3f> rays_;  // z = 1
};

}  // namespace cpslam
