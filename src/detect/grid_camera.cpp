#include "detect/grid_camera.h"

namespace cpslam {

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

int GridCamera::cell_of_undistorted(float u, float v) const {
  if (!camera_.in_image({static_cast<double>(u), static_cast<double>(v)})) return -1;
  const Eigen::Vector2d px = camera_.distort({static_cast<double>(u), static_cast<double>(v)});
  return cell_of_pixel(static_cast<float>(px.x()), static_cast<float>(px.y()));
}

}  // namespace cpslam
