#include "openni/frame_mailbox.h"

#include <utility>

namespace cpslam {

void FrameMailbox::put(CameraFrame frame) {
  const std::lock_guard lock(mutex_);
  if (frame_) ++dropped_;
  frame_ = std::move(frame);
  changed_.notify_all();
}

void FrameMailbox::close(CameraEvent why) {
  const std::lock_guard lock(mutex_);
  if (!closed_) closed_ = why;
  changed_.notify_all();
}

void FrameMailbox::fail(std::exception_ptr error) {
  const std::lock_guard lock(mutex_);
  if (!failure_) failure_ = std::move(error);
  changed_.notify_all();
}

CameraEvent FrameMailbox::take(CameraFrame& frame, std::chrono::duration<double> patience,
                               const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const auto something = [this] { return frame_ || closed_ || failure_; };
  const bool came = changed_.wait_for(lock, stop, patience, something);
  if (failure_) std::rethrow_exception(failure_);
  if (stop.stop_requested()) return CameraEvent::kStopped;
  if (!came) return CameraEvent::kStalled;
  if (!frame_) return *closed_;
  frame = *std::exchange(frame_, std::nullopt);
  return CameraEvent::kFrame;
}

std::size_t FrameMailbox::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

}  // namespace cpslam
