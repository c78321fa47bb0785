#pragma once

#include <cstdint>

#include "openni/camera_frame.h"

namespace cpslam::test {

inline CameraPicture picture(std::uint64_t time_us, double arrived_s = 0.0) {
  CameraPicture picture;
  picture.time_us = time_us;
  picture.arrived += std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(arrived_s));
  return picture;
}

inline CameraFrame frame(std::uint64_t time_us, std::uint64_t depth_time_us, double arrived_s = 0.0) {
  return {picture(time_us, arrived_s), picture(depth_time_us, arrived_s)};
}

}  // namespace cpslam::test
