#include "dense/dense_camera.h"

#include <algorithm>
#include <cmath>

namespace cpslam {
namespace {

constexpr int kUsualWidth = 320;
constexpr float kNearestM = 0.1F;

}  // namespace

DenseCamera::DenseCamera(const PinholeCamera& camera)
    : camera_(camera),
      step_(std::max(1, (camera.width() + kUsualWidth - 1) / kUsualWidth)),
      size_(camera.width() / step_, camera.height() / step_) {
  rays_.reserve(static_cast<std::size_t>(n_pixels()));
  const double middle = 0.5 * (step_ - 1);
  for (int y = 0; y < size_.height; ++y) {
    for (int x = 0; x < size_.width; ++x) {
      const Eigen::Vector2d px = camera.undistort({x * step_ + middle, y * step_ + middle});
      rays_.emplace_back(camera.back_project(px, 1.0).cast<float>());
      cone_rad_ = std::max(cone_rad_, std::atan(rays_.back().head<2>().norm()));
    }
  }
}

cv::Point DenseCamera::image_pixel_of(const Eigen::Vector3f& point_in_camera) const {
  const cv::Point outside(-1, -1);
  if (!(point_in_camera.z() > kNearestM)) return outside;
  const Eigen::Vector2d undistorted = camera_.project(point_in_camera.cast<double>());
  // Far outside, the distortion's polynomial bends back into the image.
  if (!camera_.in_image(undistorted)) return outside;
  const Eigen::Vector2d px = camera_.distort(undistorted);
  const cv::Point pixel(static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y())));
  return cv::Rect({}, image_size()).contains(pixel) ? pixel : outside;
}

int DenseCamera::pixel_of(const Eigen::Vector3f& point_in_camera) const {
  const cv::Point pixel = image_pixel_of(point_in_camera);
  if (pixel.x < 0) return -1;
  const cv::Point block(pixel.x / step_, pixel.y / step_);
  return cv::Rect({}, size_).contains(block) ? block.y * size_.width + block.x : -1;
}

}  // namespace cpslam
