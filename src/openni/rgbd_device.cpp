#include "openni/rgbd_device.h"

#include <cmath>
#include <filesystem>

#include "cpslam/error.h"
#include "openni/video_modes.h"

namespace cpslam {
namespace {

/// Between a PrimeSense camera's projector and its eye, m: what turns depths into disparities.
constexpr double kBaselineM = 0.075;

const char* what_of(openni::SensorType sensor) {
  return sensor == openni::SENSOR_COLOR ? "colour" : "depth";
}

std::string known_text(const std::vector<CameraInfo>& cameras) {
  std::string text;
  for (const CameraInfo& camera : cameras)
    text += (text.empty() ? "" : ", ") + camera.vendor + " " + camera.name + " (" + camera.uri + ")";
  return text;
}

/// The camera that is meant. Throws InputError when there is none.
CameraInfo find_camera(const std::string& wanted) {
  const std::vector<CameraInfo> cameras = list_cameras();
  if (cameras.empty())
    throw InputError("no camera that OpenNI2 knows is plugged in; is it, and may you read its USB device?");
  if (wanted.empty()) return cameras.front();
  for (const CameraInfo& camera : cameras) {
    const std::string full_name = camera.vendor + " " + camera.name;
    if (camera.uri == wanted || full_name.find(wanted) != std::string::npos) return camera;
  }
  throw InputError("--device " + wanted + ": there is no such camera or file; there is " +
                   known_text(cameras));
}

[[noreturn]] void fail(const std::string& what) {
  const std::string why = openni_error();
  throw RunError(what + (why.empty() ? "" : ": " + why));
}

double focal_length_px(int length_px, float field_of_view_rad) {
  const double focal_px = 0.5 * length_px / std::tan(0.5 * static_cast<double>(field_of_view_rad));
  return std::isfinite(focal_px) && focal_px > 0.0 ? focal_px : 0.0;
}

}  // namespace

RgbdDevice::RgbdDevice(const CameraOptions& options, const Log& log)
    : log_(log), is_file_(is_recording(options.device)) {
  if (is_file_) {
    uri_ = name_ = options.device;
  } else {
    const CameraInfo camera = find_camera(options.device);
    uri_ = camera.uri;
    name_ = camera.name + " (" + camera.uri + ")";
  }
  if (device_.open(uri_.c_str()) != openni::STATUS_OK) {
    if (is_file_) throw InputError(name_ + " is no recording that OpenNI2 can play: " + openni_error());
    fail(name_ + " cannot be opened");
  }
  create(openni::SENSOR_COLOR, colour_, options);
  create(openni::SENSOR_DEPTH, depth_, options);
  if (is_file_) {
    openni::PlaybackControl& playback = *device_.getPlaybackControl();
    playback.setRepeatEnabled(false);
    playback.setSpeed(options.at_recorded_speed ? 1.0F : -1.0F);
  } else {
    register_depth();
    if (device_.setDepthColorSyncEnabled(true) != openni::STATUS_OK)
      log_.warning("the camera does not take colour and depth at the same time");
  }
  switch_mirroring_off(colour_);
  switch_mirroring_off(depth_);
  colour_mirrored_ = colour_.getMirroringEnabled();
  depth_mirrored_ = depth_.getMirroringEnabled();
  if (options.auto_exposure) set_auto_exposure(*options.auto_exposure);
  read_settings();
}

RgbdDevice::~RgbdDevice() {
  // Both streams before either goes: OpenNI's file player crashes now and then otherwise.
  colour_.stop();
  depth_.stop();
  colour_.destroy();
  depth_.destroy();
  device_.close();
}

void RgbdDevice::create(openni::SensorType sensor, openni::VideoStream& stream,
                        const CameraOptions& options) {
  const std::string what = what_of(sensor);
  const openni::SensorInfo* const info = device_.getSensorInfo(sensor);
  if (info == nullptr) throw InputError(name_ + " has no " + what + " images");
  if (stream.create(device_, sensor) != openni::STATUS_OK) fail(name_ + ": no " + what + " images");
  if (is_file_) return;
  const openni::VideoMode mode = choose_mode(*info, what, options.width, options.height, options.fps);
  if (stream.setVideoMode(mode) != openni::STATUS_OK)
    fail(name_ + ": " + what + " images cannot be set to " +
         mode_text(options.width, options.height, options.fps));
}

void RgbdDevice::register_depth() {
  const auto mode = openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  const bool registered = device_.isImageRegistrationModeSupported(mode) &&
                          device_.setImageRegistrationMode(mode) == openni::STATUS_OK &&
                          device_.getImageRegistrationMode() == mode;
  if (registered) return;
  throw InputError(name_ +
                   " cannot register depth to colour (image registration), and depth that lies beside "
                   "the colours makes a wrong map: use another camera, or another driver for it");
}

void RgbdDevice::switch_mirroring_off(openni::VideoStream& stream) {
  // Recordings and some cameras cannot; then mirrored() says what they do.
  if (stream.getMirroringEnabled()) (void)stream.setMirroringEnabled(false);
}

void RgbdDevice::set_auto_exposure(bool on) {
  openni::CameraSettings* const camera = colour_.getCameraSettings();
  if (camera == nullptr || camera->setAutoExposureEnabled(on) != openni::STATUS_OK)
    log_.warning("the camera's exposure cannot be set: it stays as it is");
}

void RgbdDevice::read_settings() {
  const openni::VideoMode colour = colour_.getVideoMode();
  const openni::VideoMode depth = depth_.getVideoMode();
  settings_.width = colour.getResolutionX();
  settings_.height = colour.getResolutionY();
  if (depth.getResolutionX() != settings_.width || depth.getResolutionY() != settings_.height) {
    throw InputError(name_ +
                     ": its depth images are of another size than its colour images: depth must be "
                     "registered to colour");
  }
  settings_.fps = colour.getFps();
  settings_.depth_map_factor = units_per_metre(depth.getPixelFormat());
  if (settings_.depth_map_factor <= 0.0) throw InputError(name_ + ": its depth images hold no lengths");
  settings_.fx = focal_length_px(settings_.width, colour_.getHorizontalFieldOfView());
  settings_.fy = focal_length_px(settings_.height, colour_.getVerticalFieldOfView());
  settings_.cx = 0.5 * (settings_.width - 1);
  settings_.cy = 0.5 * (settings_.height - 1);
  settings_.bf = kBaselineM * settings_.fx;
}

void RgbdDevice::start() {
  if (colour_.start() != openni::STATUS_OK) fail(name_ + ": colour images do not start");
  if (depth_.start() != openni::STATUS_OK) fail(name_ + ": depth images do not start");
}

int RgbdDevice::n_pictures(const openni::VideoStream& stream) {
  return is_file_ ? device_.getPlaybackControl()->getNumberOfFrames(stream) : 0;
}

}  // namespace cpslam
