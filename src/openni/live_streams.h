#pragma once

#include <mutex>

#include "openni/frame_mailbox.h"
#include "openni/frame_pairer.h"
#include "openni/frame_source.h"
#include "openni/rgbd_device.h"

namespace cpslam {

/// Takes pictures from OpenNI's threads as they come and keeps the newest frame. Who is too slow for the
/// camera loses frames, never time.
class LiveStreams : public FrameSource, private openni::OpenNI::DeviceDisconnectedListener {
 public:
  /// Starts the device, which must outlive this.
  explicit LiveStreams(RgbdDevice& device);
  ~LiveStreams() override;
  LiveStreams(const LiveStreams&) = delete;
  LiveStreams& operator=(const LiveStreams&) = delete;

  CameraEvent next(CameraFrame& frame, std::chrono::duration<double> patience,
                   const std::stop_token& stop) override;
  [[nodiscard]] CameraCounts counts() const override;

 private:
  /// A listener serves a single stream: it holds one handle.
  class Listener : public openni::VideoStream::NewFrameListener {
   public:
    Listener(LiveStreams& owner, openni::SensorType sensor) : owner_(owner), sensor_(sensor) {}
    void onNewFrame(openni::VideoStream& stream) override;

   private:
    LiveStreams& owner_;
    const openni::SensorType sensor_;
  };

  void onDeviceDisconnected(const openni::DeviceInfo* info) override;
  void take(openni::VideoStream& stream, openni::SensorType sensor);
  void count(openni::SensorType sensor, int index);

  RgbdDevice& device_;
  Listener colour_listener_, depth_listener_;
  const int last_colour_, last_depth_;  // numbers of a file's last pictures; 0: a camera
  FrameMailbox mailbox_;
  mutable std::mutex mutex_;  // guards what follows
  FramePairer pairer_;
  CameraCounts counts_;
  int colour_index_ = 0, depth_index_ = 0;  // of the latest pictures
};

}  // namespace cpslam
