#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace cpslam {

/// One of the camera's pictures.
struct CameraPicture {
  cv::Mat image;              ///< CV_8UC3 (B,G,R) or CV_8UC1; depth: CV_16UC1 in the camera's units
  std::uint64_t time_us = 0;  ///< by the camera's clock
  std::chrono::steady_clock::time_point arrived;
};

/// A colour image with the depth image that was taken with it.
struct CameraFrame {
  CameraPicture colour;
  CameraPicture depth;
};

/// Pictures that did not become frames, since the camera was opened.
struct CameraCounts {
  std::size_t dropped = 0;   ///< colour with depth: replaced by newer ones before anybody took them
  std::size_t unpaired = 0;  ///< colour images without depth
  std::size_t missed = 0;    ///< colour images the camera numbered that never came
};

enum class CameraEvent {
  kFrame,
  kEnd,        ///< of a file
  kStalled,    ///< nothing came for too long
  kUnplugged,  ///< the camera is gone
  kStopped,    ///< by the stop token
};

}  // namespace cpslam
