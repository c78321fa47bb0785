#include "openni/rgbd_camera.h"

#include <filesystem>

#include "openni/file_streams.h"
#include "openni/live_streams.h"
#include "openni/rgbd_device.h"

namespace cpslam {
namespace {

std::unique_ptr<FrameSource> make_source(RgbdDevice& device, const CameraOptions& options) {
  if (device.is_file() && !options.at_recorded_speed) return std::make_unique<FileStreams>(device);
  return std::make_unique<LiveStreams>(device);
}

}  // namespace

bool is_recording(const std::string& device) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(device, ignored);
}

struct RgbdCamera::Impl {
  Impl(const CameraOptions& options_in, const Log& user_log)
      : options(options_in), log(user_log), device(options, log) {}

  const CameraOptions options;
  const Log log;
  RgbdDevice device;
  std::unique_ptr<FrameSource> source;
};

RgbdCamera::RgbdCamera(const CameraOptions& options, const Log& log)
    : impl_(std::make_unique<Impl>(options, log)) {}

RgbdCamera::~RgbdCamera() = default;

const std::string& RgbdCamera::name() const {
  return impl_->device.name();
}

const CameraSettings& RgbdCamera::settings() const {
  return impl_->device.settings();
}

void RgbdCamera::start() {
  impl_->source = make_source(impl_->device, impl_->options);
}

CameraEvent RgbdCamera::next(CameraFrame& frame, std::chrono::duration<double> patience,
                             const std::stop_token& stop) {
  return impl_->source->next(frame, patience, stop);
}

CameraCounts RgbdCamera::counts() const {
  return impl_->source ? impl_->source->counts() : CameraCounts{};
}

}  // namespace cpslam
