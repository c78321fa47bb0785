#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "camera/pinhole_camera.h"

namespace cpslam {

/// A camera as a dense view sees it: square blocks of pixels, some 320 across whatever the camera has.
/// Numbered in raster order. Immutable, so safe to share.
class DenseCamera {
 public:
  explicit DenseCamera(const PinholeCamera& camera);

  [[nodiscard]] int step() const { return step_; }  ///< side of a block, px of the camera
  [[nodiscard]] cv::Size size() const { return size_; }
  [[nodiscard]] int n_pixels() const { return size_.area(); }
  [[nodiscard]] cv::Size image_size() const { return {camera_.width(), camera_.height()}; }

  /// Direction through the middle of a block, z = 1.
  [[nodiscard]] const Eigen::Vector3f& ray(int pixel) const { return rays_[static_cast<std::size_t>(pixel)]; }
  /// Pixel of the camera's image in which a point in the camera frame (m) lies; (-1, -1) outside.
  [[nodiscard]] cv::Point image_pixel_of(const Eigen::Vector3f& point_in_camera) const;
  /// The block in which it lies; -1 outside.
  [[nodiscard]] int pixel_of(const Eigen::Vector3f& point_in_camera) const;
  /// Half the opening angle (rad) of a cone around the optical axis that holds the whole image.
  [[nodiscard]] float cone_rad() const { return cone_rad_; }

 private:
  PinholeCamera camera_;
  int step_;
  cv::Size size_;
  std::vector<Eigen::Vector3f> rays_;
  float cone_rad_ = 0.0F;
};

}  // namespace cpslam
