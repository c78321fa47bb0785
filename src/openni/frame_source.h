#pragma once

#include <chrono>
#include <stop_token>

#include "openni/camera_frame.h"

namespace cpslam {

/// How frames come out of an open device; one way for cameras, one for files that are read in full.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  [[nodiscard]] virtual CameraEvent next(CameraFrame& frame, std::chrono::duration<double> patience,
                                         const std::stop_token& stop) = 0;
  [[nodiscard]] virtual CameraCounts counts() const = 0;
};

}  // namespace cpslam
