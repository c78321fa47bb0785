#pragma once

#include <OpenNI.h>

#include <string>

#include "cpslam/settings.h"
#include "openni/library.h"
#include "openni/rgbd_camera.h"
#include "util/log.h"

namespace cpslam {

/// An open device with its two streams set up and not yet started.
class RgbdDevice {
 public:
  /// Throws InputError when there is no such camera or it cannot do what is needed, RunError when it fails.
  RgbdDevice(const CameraOptions& options, const Log& log);
  ~RgbdDevice();
  RgbdDevice(const RgbdDevice&) = delete;
  RgbdDevice& operator=(const RgbdDevice&) = delete;

  /// Throws RunError when the camera does not start.
  void start();

  [[nodiscard]] const std::string& uri() const { return uri_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool is_file() const { return is_file_; }
  [[nodiscard]] const CameraSettings& settings() const { return settings_; }
  /// Its pictures come mirrored, though asked not to be.
  [[nodiscard]] bool mirrored(openni::SensorType sensor) const {
    return sensor == openni::SENSOR_COLOR ? colour_mirrored_ : depth_mirrored_;
  }

  openni::VideoStream& colour() { return colour_; }
  openni::VideoStream& depth() { return depth_; }
  /// Pictures in a file; 0 for a camera.
  [[nodiscard]] int n_pictures(const openni::VideoStream& stream);

 private:
  void create(openni::SensorType sensor, openni::VideoStream& stream, const CameraOptions& options);
  void register_depth();
  void switch_mirroring_off(openni::VideoStream& stream);
  void set_auto_exposure(bool on);
  void read_settings();

  const Log& log_;
  const OpenNiLibrary library_;
  const bool is_file_;
  std::string uri_, name_;
  openni::Device device_;
  openni::VideoStream colour_, depth_;
  bool colour_mirrored_ = false, depth_mirrored_ = false;
  CameraSettings settings_;
};

}  // namespace cpslam
