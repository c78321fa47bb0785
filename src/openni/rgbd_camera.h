#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "cpslam/settings.h"
#include "openni/camera_frame.h"
#include "util/log.h"

namespace cpslam {

struct CameraOptions {
  std::string device;  ///< URI, part of vendor and name, or an .oni file; empty: the first camera
  int width = 640;     ///< of a camera's images, px; a file has its own
  int height = 480;
  int fps = 30;                       ///< of a camera
  std::optional<bool> auto_exposure;  ///< empty: as the camera comes
  bool at_recorded_speed = false;     ///< a file drops frames that nobody takes, as a camera does
};

/// Whether the options' device is a file.
[[nodiscard]] bool is_recording(const std::string& device);

/// An RGB-D camera, or a file recorded from one, through OpenNI2: colour with depth registered to it, paired
/// by the camera's clock, not mirrored.
class RgbdCamera {
 public:
  /// Opens it and sets it up. Throws InputError when there is no such camera or it cannot do what is needed,
  /// RunError when it fails.
  RgbdCamera(const CameraOptions& options, const Log& log);
  ~RgbdCamera();
  RgbdCamera(const RgbdCamera&) = delete;
  RgbdCamera& operator=(const RgbdCamera&) = delete;

  /// "Virtual Camera (virtual://0)", or the file.
  [[nodiscard]] const std::string& name() const;
  /// What the device says about itself: sizes, rate, units of depth, and a pinhole made of the field of view.
  [[nodiscard]] const CameraSettings& settings() const;

  /// Lets it deliver. Throws RunError when it does not.
  void start();

  /// After start(): the next frame; of a camera the newest. Waits no longer than patience (a file read in
  /// full: as long as it takes to read). Throws RunError for pictures that cannot be used.
  [[nodiscard]] CameraEvent next(CameraFrame& frame, std::chrono::duration<double> patience,
                                 const std::stop_token& stop);

  [[nodiscard]] CameraCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cpslam
