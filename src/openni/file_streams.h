#pragma once

#include "openni/frame_pairer.h"
#include "openni/frame_source.h"
#include "openni/rgbd_device.h"

namespace cpslam {

/// Reads every frame of a file, as fast as they are taken. One thread.
class FileStreams : public FrameSource {
 public:
  /// Starts the device, which must outlive this.
  explicit FileStreams(RgbdDevice& device);

  CameraEvent next(CameraFrame& frame, std::chrono::duration<double> patience,
                   const std::stop_token& stop) override;
  [[nodiscard]] CameraCounts counts() const override;

 private:
  RgbdDevice& device_;
  int left_;  // pictures still in the file
  FramePairer pairer_;
};

}  // namespace cpslam
