#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "dense/dense_camera.h"
#include "geometry/se3.h"

namespace cpslam {

/// What a keyframe saw of the room, reduced to the blocks of a DenseCamera: 5 bytes each, 384 kB with 640 x
/// 480 px.
struct DenseView {
  static constexpr float kUnitsPerM = 5000.0F;   ///< up to 13.1 m
  cv::Mat1w depth;                               ///< 0: no reading, or on something that moves
  std::vector<std::array<std::uint8_t, 3>> rgb;  ///< parallel to depth, in raster order

  [[nodiscard]] float depth_m(int pixel) const {
    return static_cast<float>(depth.at<std::uint16_t>(pixel / depth.cols, pixel % depth.cols)) / kUnitsPerM;
  }
  [[nodiscard]] std::size_t n_bytes() const { return depth.total() * sizeof(std::uint16_t) + rgb.size() * 3; }
};

/// A frame to make a view of.
struct DenseFrame {
  cv::Mat colour;  ///< CV_8UC3 (B,G,R) or CV_8UC1
  cv::Mat depth;   ///< CV_16UC1 or CV_32FC1
  double metres_per_unit = 0.001;
  cv::Mat moving;                 ///< CV_8UC1: non-zero in depth on what moves by itself; empty: nothing
  SE3 colour_cam_from_depth_cam;  ///< when the two images are of different instants
};

/// The depth of a block is the mean of its readings on its nearest surface. What moves goes with a margin,
/// and with a wider one where the surface goes on without a step: the mask's outline is not exact, and hair,
/// hands and feet are missed first. Thread-safe.
[[nodiscard]] DenseView make_dense_view(const DenseCamera& camera, const DenseFrame& frame);

}  // namespace cpslam
