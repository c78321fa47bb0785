#pragma once

#include <cstdint>
#include <string>

#include "virtual_camera/openni_driver_api.h"
#include "virtual_camera/player.h"

namespace cpslam::virtual_camera {

[[nodiscard]] OniVideoMode video_mode(OniSensorType sensor, const Film& film);

/// One of the camera's two streams, as OpenNI's core sees it.
class VirtualStream : public oni::driver::StreamBase, public PictureSink {
 public:
  VirtualStream(OniSensorType sensor, Player& player);
  ~VirtualStream() override { stop(); }

  OniStatus start() override;
  void stop() override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;

  void deliver(const cv::Mat& picture, std::uint64_t time_us, int index) override;

 private:
  [[nodiscard]] bool is_colour() const { return sensor_ == ONI_SENSOR_COLOR; }

  const OniSensorType sensor_;
  Player& player_;
  const OniVideoMode mode_;
  OniBool mirrored_ = 1;  // as PrimeSense cameras come
  OniBool auto_exposure_ = 1;
  OniBool auto_white_balance_ = 1;
};

}  // namespace cpslam::virtual_camera
