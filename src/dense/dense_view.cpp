#include "dense/dense_view.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace cpslam {
namespace {

/// Readings of a block this near (relative) to its nearest one are on the same surface.
constexpr float kSameSurface = 0.02F;
constexpr float kFarthestM = 65535.0F / DenseView::kUnitsPerM;
/// Blocks around what moves that go in any case, and while the surface goes on.
constexpr int kMargin = 2;
constexpr int kWideMargin = 8;
/// Neighbouring blocks whose depths differ less (m, and relative) are one surface.
constexpr float kStepM = 0.01F;
constexpr float kRelativeStep = 0.015F;

template <typename Unit>
float block_depth_m(const cv::Mat& depth, float metres_per_unit, const cv::Rect& block) {
  float nearest_m = kFarthestM;
  const auto for_each_reading = [&](auto&& use) {
    for (int y = block.y; y < block.br().y; ++y) {
      const Unit* const row = depth.ptr<Unit>(y);
      for (int x = block.x; x < block.br().x; ++x) {
        const float d = static_cast<float>(row[x]) * metres_per_unit;
        if (d > 0.0F && d < kFarthestM) use(d);
      }
    }
  };
  for_each_reading([&](float d) { nearest_m = std::min(nearest_m, d); });
  float sum_m = 0.0F;
  int n = 0;
  for_each_reading([&](float d) {
    if (d > nearest_m * (1.0F + kSameSurface)) return;
    sum_m += d;
    ++n;
  });
  return n > 0 ? sum_m / static_cast<float>(n) : 0.0F;
}

cv::Mat1f block_depths_m(const DenseCamera& camera, const DenseFrame& frame) {
  cv::Mat1f depth_m(camera.size());
  const auto metres_per_unit = static_cast<float>(frame.metres_per_unit);
  const int step = camera.step();
  for (int y = 0; y < depth_m.rows; ++y) {
    for (int x = 0; x < depth_m.cols; ++x) {
      const cv::Rect block(x * step, y * step, step, step);
      depth_m(y, x) = frame.depth.type() == CV_16UC1
                          ? block_depth_m<std::uint16_t>(frame.depth, metres_per_unit, block)
                          : block_depth_m<float>(frame.depth, metres_per_unit, block);
    }
  }
  return depth_m;
}

bool is_one_surface(float a_m, float b_m) {
  return a_m > 0.0F && b_m > 0.0F && std::abs(a_m - b_m) < kStepM + kRelativeStep * std::min(a_m, b_m);
}

/// One block further, where the surface goes on.
cv::Mat1b grow_on_surface(const cv::Mat1b& moving, const cv::Mat1f& depth_m) {
  cv::Mat1b grown = moving.clone();
  for (int y = 0; y < moving.rows; ++y) {
    for (int x = 0; x < moving.cols; ++x) {
      if (moving(y, x) != 0) continue;
      const auto reached_from = [&](int v, int u) {
        return u >= 0 && v >= 0 && u < moving.cols && v < moving.rows && moving(v, u) != 0 &&
               is_one_surface(depth_m(v, u), depth_m(y, x));
      };
      if (reached_from(y, x - 1) || reached_from(y, x + 1) || reached_from(y - 1, x) ||
          reached_from(y + 1, x))
        grown(y, x) = 255;
    }
  }
  return grown;
}

cv::Mat1b moving_blocks(const DenseCamera& camera, const DenseFrame& frame, const cv::Mat1f& depth_m) {
  cv::Mat1b moving(camera.size(), std::uint8_t{0});
  if (frame.moving.empty()) return moving;
  const int step = camera.step();
  for (int y = 0; y < moving.rows; ++y) {
    for (int x = 0; x < moving.cols; ++x) {
      const cv::Rect block(x * step, y * step, step, step);
      if (cv::countNonZero(frame.moving(block)) > 0) moving(y, x) = 255;
    }
  }
  for (int i = 0; i < kWideMargin; ++i) moving = grow_on_surface(moving, depth_m);
  const int side = 2 * kMargin + 1;
  cv::dilate(moving, moving, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  return moving;
}

std::array<std::uint8_t, 3> rgb_at(const cv::Mat& colour, const cv::Point& at) {
  if (colour.channels() == 1) {
    const std::uint8_t grey = colour.at<std::uint8_t>(at);
    return {grey, grey, grey};
  }
  const auto& bgr = colour.at<cv::Vec3b>(at);
  return {bgr[2], bgr[1], bgr[0]};
}

}  // namespace

DenseView make_dense_view(const DenseCamera& camera, const DenseFrame& frame) {
  const cv::Mat1f depth_m = block_depths_m(camera, frame);
  const cv::Mat1b moving = moving_blocks(camera, frame, depth_m);
  const Eigen::Matrix3f rotation = frame.colour_cam_from_depth_cam.rotation.cast<float>();
  const Eigen::Vector3f translation = frame.colour_cam_from_depth_cam.translation.cast<float>();
  DenseView view;
  view.depth = cv::Mat1w(camera.size(), std::uint16_t{0});
  view.rgb.resize(view.depth.total());
  for (int pixel = 0; pixel < camera.n_pixels(); ++pixel) {
    const cv::Point block(pixel % view.depth.cols, pixel / view.depth.cols);
    const float d = depth_m(block);
    if (d <= 0.0F || moving(block) != 0) continue;
    const cv::Point at = camera.image_pixel_of(rotation * (camera.ray(pixel) * d) + translation);
    if (at.x < 0) continue;
    view.depth(block) = static_cast<std::uint16_t>(std::lround(d * DenseView::kUnitsPerM));
    view.rgb[static_cast<std::size_t>(pixel)] = rgb_at(frame.colour, at);
  }
  return view;
}

}  // namespace cpslam
