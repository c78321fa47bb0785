#include "openni/live_streams.h"

#include <exception>
#include <optional>
#include <utility>

#include "openni/picture_conversion.h"

namespace cpslam {

LiveStreams::LiveStreams(RgbdDevice& device)
    : device_(device),
      colour_listener_(*this, openni::SENSOR_COLOR),
      depth_listener_(*this, openni::SENSOR_DEPTH),
      last_colour_(device.n_pictures(device.colour())),
      last_depth_(device.n_pictures(device.depth())),
      pairer_(pair_tolerance_s(device.settings().fps)) {
  openni::OpenNI::addDeviceDisconnectedListener(this);
  device_.colour().addNewFrameListener(&colour_listener_);
  device_.depth().addNewFrameListener(&depth_listener_);
  device_.start();
}

LiveStreams::~LiveStreams() {
  // OpenNI waits for a call that is under way; it must not find us holding a lock.
  device_.colour().removeNewFrameListener(&colour_listener_);
  device_.depth().removeNewFrameListener(&depth_listener_);
  openni::OpenNI::removeDeviceDisconnectedListener(this);
}

CameraEvent LiveStreams::next(CameraFrame& frame, std::chrono::duration<double> patience,
                              const std::stop_token& stop) {
  return mailbox_.take(frame, patience, stop);
}

CameraCounts LiveStreams::counts() const {
  const std::lock_guard lock(mutex_);
  CameraCounts counts = counts_;
  counts.dropped = mailbox_.dropped();
  counts.unpaired = pairer_.unpaired();
  return counts;
}

void LiveStreams::Listener::onNewFrame(openni::VideoStream& stream) {
  try {
    owner_.take(stream, sensor_);
  } catch (...) {  // must not run into OpenNI's thread
    owner_.mailbox_.fail(std::current_exception());
  }
}

void LiveStreams::onDeviceDisconnected(const openni::DeviceInfo* info) {
  if (info != nullptr && device_.uri() == info->getUri()) mailbox_.close(CameraEvent::kUnplugged);
}

void LiveStreams::take(openni::VideoStream& stream, openni::SensorType sensor) {
  // The call may come for a picture that the last call has taken: reading would wait for the next one, for
  // ever where the camera is gone, and nobody could end this thread.
  openni::VideoStream* waiting = &stream;
  int ready = -1;
  if (openni::OpenNI::waitForAnyStream(&waiting, 1, &ready, openni::TIMEOUT_NONE) != openni::STATUS_OK)
    return;
  openni::VideoFrameRef raw;
  if (stream.readFrame(&raw) != openni::STATUS_OK || !raw.isValid()) return;
  CameraPicture picture = copy_picture(raw, device_.mirrored(sensor));
  const std::lock_guard lock(mutex_);
  const bool is_colour = sensor == openni::SENSOR_COLOR;
  std::optional<CameraFrame> frame =
      is_colour ? pairer_.add_colour(std::move(picture)) : pairer_.add_depth(std::move(picture));
  if (frame) mailbox_.put(*std::move(frame));
  count(sensor, raw.getFrameIndex());
}

void LiveStreams::count(openni::SensorType sensor, int index) {
  if (sensor == openni::SENSOR_COLOR) {
    if (colour_index_ > 0 && index > colour_index_ + 1)
      counts_.missed += static_cast<std::size_t>(index - colour_index_ - 1);
    colour_index_ = index;
  } else {
    depth_index_ = index;
  }
  if (last_colour_ > 0 && colour_index_ >= last_colour_ && depth_index_ >= last_depth_)
    mailbox_.close(CameraEvent::kEnd);
}

}  // namespace cpslam
