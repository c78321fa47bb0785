#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>

#include "openni/camera_frame.h"

namespace cpslam {

/// Room for one frame between the camera's threads and the one that tracks: the newest frame wins. All
/// members are thread-safe.
class FrameMailbox {
 public:
  void put(CameraFrame frame);
  /// Nothing more comes: kEnd or kUnplugged. The frame that lies here can still be taken.
  void close(CameraEvent why);
  /// take() throws this from now on.
  void fail(std::exception_ptr error);

  /// Waits for a frame, no longer than patience.
  [[nodiscard]] CameraEvent take(CameraFrame& frame, std::chrono::duration<double> patience,
                                 const std::stop_token& stop);

  /// Frames that were replaced before they were taken.
  [[nodiscard]] std::size_t dropped() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<CameraFrame> frame_;
  std::optional<CameraEvent> closed_;
  std::exception_ptr failure_;
  std::size_t dropped_ = 0;
};

}  // namespace cpslam
