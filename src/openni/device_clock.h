#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "openni/camera_frame.h"

namespace cpslam {

/// Turns a camera's stamps into seconds that grow from frame to frame, whatever the camera's clock does. The
/// seconds are the camera's own until its clock first jumps or the camera is opened anew; from then on they
/// go on as the host's clock does. Reckons in whole microseconds, so nothing is rounded away. Not
/// thread-safe.
class DeviceClock {
 public:
  using HostTime = std::chrono::steady_clock::time_point;

  /// live: the host's clock at arrival tells how much time has really passed. A file has no such clock: when
  /// it jumps back, one interval is taken to have passed; a gap of up to an hour stands as it is.
  DeviceClock(bool live, double interval_s);

  struct Times {
    double time_s = 0.0;  ///< of the colour image
    double depth_time_s = 0.0;
    std::optional<double> jump_s;  ///< the camera's clock jumped by so much, back when negative
  };
  [[nodiscard]] Times read(const CameraFrame& frame);

  /// The camera was opened anew: its clock has nothing to do with the one before.
  void restart() { restarted_ = true; }

 private:
  [[nodiscard]] std::int64_t expected_us(const CameraFrame& frame) const;

  const bool live_;
  const std::int64_t interval_us_;
  bool started_ = false;
  bool restarted_ = false;
  std::uint64_t last_us_ = 0;  // by the camera's clock
  std::int64_t now_us_ = 0;    // as handed out
  HostTime last_arrived_;
};

}  // namespace cpslam
