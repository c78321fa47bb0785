#include "detect/grid_camera.h"

#include <cmath>

#include "detect/depth_grid.h"

namespace cpslam {
namespace {

constexpr float kNearestM = 0.1F;

}  // namespace

GridCamera::GridCamera(const PinholeCamera& camera)
    : camera_(camera),
      size_(camera.width() / kDepthCellPx, camera.height() / kDepthCellPx),
      fx_(static_cast<float>(camera.fx())),
      fy_(static_cast<float>(camera.fy())),
      cx_(static_cast<float>(camera.cx())),
      cy_(static_cast<float>(camera.cy())) {
  constexpr double kMiddle = (kDepthCellPx - 1) / 2.0;
  rays_.reserve(static_cast<std::size_t>(n_cells()));
  for (int y = 0; y < size_.height; ++y) {
    for (int x = 0; x < size_.width; ++x) {
      const Eigen::Vector2d middle_px(x * kDepthCellPx + kMiddle, y * kDepthCellPx + kMiddle);
      rays_.push_back(camera.back_project(camera.undistort(middle_px), 1.0).cast<float>());
    }
  }
}

int GridCamera::cell_of(const Eigen::Vector3f& point_in_camera) const {
  if (point_in_camera.z() < kNearestM) return -1;
  const float inverse_z = 1.0F / point_in_camera.z();
  const float u = fx_ * point_in_camera.x() * inverse_z + cx_;
  const float v = fy_ * point_in_camera.y() * inverse_z + cy_;
  if (!camera_.has_distortion()) return cell_of_pixel(u, v);
  if (!camera_.in_image({static_cast<double>(u), static_cast<double>(v)})) return -1;
  const Eigen::Vector2d px = camera_.distort({static_cast<double>(u), static_cast<double>(v)});
  return cell_of_pixel(static_cast<float>(px.x()), static_cast<float>(px.y()));
}

int GridCamera::cell_of_pixel(float x, float y) const {
  // A pixel's area reaches half a pixel around its coordinates.
  const float column = std::floor((x + 0.5F) / static_cast<float>(kDepthCellPx));
  const float row = std::floor((y + 0.5F) / static_cast<float>(kDepthCellPx));
  if (!(column >= 0.0F) || !(row >= 0.0F) || column >= static_cast<float>(size_.width) ||
      row >= static_cast<float>(size_.height)) {
    return -1;
  }
  return static_cast<int>(row) * size_.width + static_cast<int>(column);
}

}  // namespace cpslam
