#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "cpslam/settings.h"
#include "virtual_camera/camera_script.h"

namespace cpslam::virtual_camera {

/// A sequence in memory, played forward and backward without end, as a camera's raw pictures.
class Film {
 public:
  struct Picture {
    cv::Mat rgb;       ///< CV_8UC3, R,G,B
    cv::Mat depth_mm;  ///< CV_16UC1
  };
  struct Step {
    const Picture& picture;
    std::int64_t depth_delay_us = 0;  ///< stamp of the depth image less that of the colour image
    std::uint64_t interval_us = 0;    ///< to the next step
  };

  /// Decodes all of it. Throws InputError for a sequence that cannot be read.
  explicit Film(const CameraScript& script);

  /// n counts from 0.
  [[nodiscard]] Step step(std::size_t n) const;
  [[nodiscard]] const CameraSettings& camera() const { return camera_; }
  /// Frames a second, rounded.
  [[nodiscard]] int fps() const;

 private:
  CameraSettings camera_;
  std::optional<double> fps_;
  std::vector<Picture> pictures_;
  std::vector<double> times_s_, depth_times_s_;
};

}  // namespace cpslam::virtual_camera
