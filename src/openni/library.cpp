#include "openni/library.h"

#include <OpenNI.h>

#include <condition_variable>
#include <mutex>

#include "cpslam/error.h"
#include "io/text_table.h"

namespace cpslam {

OpenNiLibrary::OpenNiLibrary() {
  if (openni::OpenNI::initialize() == openni::STATUS_OK) return;
  const std::string why = openni_error();
  throw RunError("OpenNI2 does not start: " + why);
}

OpenNiLibrary::~OpenNiLibrary() {
  openni::OpenNI::shutdown();
}

struct CameraWatch::Impl : openni::OpenNI::DeviceConnectedListener {
  Impl() { openni::OpenNI::addDeviceConnectedListener(this); }
  ~Impl() override { openni::OpenNI::removeDeviceConnectedListener(this); }
  void onDeviceConnected(const openni::DeviceInfo* /*info*/) override {
    const std::lock_guard lock(mutex);
    plugged_in = true;
    changed.notify_all();
  }

  const OpenNiLibrary library;
  std::mutex mutex;
  std::condition_variable_any changed;
  bool plugged_in = false;  // since the last wait
};

CameraWatch::CameraWatch() : impl_(std::make_unique<Impl>()) {}

CameraWatch::~CameraWatch() = default;

void CameraWatch::wait_for_camera(std::chrono::duration<double> patience, const std::stop_token& stop) {
  std::unique_lock lock(impl_->mutex);
  impl_->changed.wait_for(lock, stop, patience, [this] { return impl_->plugged_in; });
  impl_->plugged_in = false;
}

std::string openni_error() {
  const char* const text = openni::OpenNI::getExtendedError();
  std::string line(text == nullptr ? "" : text);
  line.erase(line.find_last_not_of(" \t\r\n") + 1);
  return printable(line);
}

std::vector<CameraInfo> list_cameras() {
  const OpenNiLibrary library;
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  std::vector<CameraInfo> cameras;
  for (int i = 0; i < devices.getSize(); ++i) {
    cameras.push_back({devices[i].getUri(), devices[i].getVendor(), devices[i].getName()});
  }
  return cameras;
}

}  // namespace cpslam
