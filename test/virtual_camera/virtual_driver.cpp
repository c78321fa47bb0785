// An OpenNI2 driver whose one camera plays a TUM-format sequence: CPSLAM_VIRTUAL_CAMERA holds its script.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string>

#include "virtual_camera/virtual_stream.h"

namespace cpslam::virtual_camera {
namespace {

constexpr const char* kUri = "virtual://0";

class VirtualDevice : public oni::driver::DeviceBase {
 public:
  explicit VirtualDevice(Player& player) : player_(player) {
    for (std::size_t i = 0; i < kSensors.size(); ++i) {
      modes_[i] = video_mode(kSensors[i], player.film());
      sensors_[i] = {kSensors[i], 1, &modes_[i]};
    }
    player_.open();
  }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = sensors_.data();
    *count = static_cast<int>(sensors_.size());
    return ONI_STATUS_OK;
  }
  oni::driver::StreamBase* createStream(OniSensorType sensor) override {
    if (sensor != ONI_SENSOR_COLOR && sensor != ONI_SENSOR_DEPTH) return nullptr;
    return new VirtualStream(sensor, player_);  // OpenNI hands it back to destroyStream
  }
  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }

  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override {
    return mode == ONI_IMAGE_REGISTRATION_OFF || player_.script().registration ? 1 : 0;
  }
  OniBool isPropertySupported(int id) override {
    return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION && player_.script().registration ? 1 : 0;
  }
  OniStatus getProperty(int id, void* data, int* size) override {
    if (isPropertySupported(id) == 0) return ONI_STATUS_NOT_SUPPORTED;
    if (*size != static_cast<int>(sizeof registration_)) return ONI_STATUS_BAD_PARAMETER;
    std::memcpy(data, &registration_, sizeof registration_);
    return ONI_STATUS_OK;
  }
  OniStatus setProperty(int id, const void* data, int size) override {
    if (isPropertySupported(id) == 0) return ONI_STATUS_NOT_SUPPORTED;
    if (size != static_cast<int>(sizeof registration_)) return ONI_STATUS_BAD_PARAMETER;
    std::memcpy(&registration_, data, sizeof registration_);
    return ONI_STATUS_OK;
  }

 private:
  static constexpr std::array kSensors{ONI_SENSOR_COLOR, ONI_SENSOR_DEPTH};
  Player& player_;
  std::array<OniVideoMode, 2> modes_{};
  std::array<OniSensorInfo, 2> sensors_{};
  OniImageRegistrationMode registration_ = ONI_IMAGE_REGISTRATION_OFF;
};

class VirtualDriver : public oni::driver::DriverBase {
 public:
  explicit VirtualDriver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    const char* const script = std::getenv("CPSLAM_VIRTUAL_CAMERA");
    if (script == nullptr) return ONI_STATUS_OK;
    try {
      player_.emplace(parse_script(script), [this](bool plugged) { report(plugged); });
    } catch (const std::exception& error) {
      std::fprintf(stderr, "virtual camera: %s\n", error.what());  // OpenNI2 keeps it to itself
      return ONI_STATUS_ERROR;
    }
    report(true);
    return ONI_STATUS_OK;
  }
  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* /*mode*/) override {
    if (!player_ || std::strcmp(uri, kUri) != 0 || !player_->plugged()) return nullptr;
    return new VirtualDevice(*player_);  // OpenNI hands it back to deviceClose
  }
  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }
  void* enableFrameSync(oni::driver::StreamBase** /*streams*/, int /*count*/) override { return this; }
  void shutdown() override { player_.reset(); }

 private:
  void report(bool plugged) {
    OniDeviceInfo info{};
    std::strncpy(info.uri, kUri, sizeof info.uri - 1);
    std::strncpy(info.vendor, "CP-SLAM", sizeof info.vendor - 1);
    std::strncpy(info.name, "Virtual Camera", sizeof info.name - 1);
    plugged ? deviceConnected(&info) : deviceDisconnected(&info);
  }
  std::optional<Player> player_;
};

}  // namespace
}  // namespace cpslam::virtual_camera

using cpslam::virtual_camera::VirtualDriver;
ONI_EXPORT_DRIVER(VirtualDriver)
