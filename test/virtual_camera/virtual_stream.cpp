#include "virtual_camera/virtual_stream.h"

#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>

namespace cpslam::virtual_camera {
namespace {

template <typename Value>
OniStatus give(const Value& value, void* data, int* size) {
  if (*size != static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof value);
  return ONI_STATUS_OK;
}

template <typename Value>
OniStatus take(Value& value, const void* data, int size) {
  if (size != static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(&value, data, sizeof value);
  return ONI_STATUS_OK;
}

float field_of_view(int length_px, double focal_px) {
  return static_cast<float>(2.0 * std::atan(0.5 * length_px / focal_px));
}

bool same(const OniVideoMode& a, const OniVideoMode& b) {
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX && a.resolutionY == b.resolutionY &&
         a.fps == b.fps;
}

}  // namespace

OniVideoMode video_mode(OniSensorType sensor, const Film& film) {
  OniVideoMode mode{};
  mode.pixelFormat = sensor == ONI_SENSOR_COLOR ? ONI_PIXEL_FORMAT_RGB888 : ONI_PIXEL_FORMAT_DEPTH_1_MM;
  mode.resolutionX = film.camera().width;
  mode.resolutionY = film.camera().height;
  mode.fps = film.fps();
  return mode;
}

VirtualStream::VirtualStream(OniSensorType sensor, Player& player)
    : sensor_(sensor), player_(player), mode_(video_mode(sensor, player.film())) {}

OniStatus VirtualStream::start() {
  is_colour() ? player_.set_colour_sink(this) : player_.set_depth_sink(this);
  return ONI_STATUS_OK;
}

void VirtualStream::stop() {
  is_colour() ? player_.set_colour_sink(nullptr) : player_.set_depth_sink(nullptr);
}

OniStatus VirtualStream::getProperty(int id, void* data, int* size) {
  const CameraSettings& camera = player_.film().camera();
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return give(mode_, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return give(field_of_view(camera.width, camera.fx), data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return give(field_of_view(camera.height, camera.fy), data, size);
    case ONI_STREAM_PROPERTY_CROPPING:  // asked for when a stream is recorded
      return give(OniCropping{}, data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return give(mirrored_, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return give(0, data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return give(is_colour() ? 255 : 65535, data, size);
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return is_colour() ? give(auto_exposure_, data, size) : ONI_STATUS_NOT_SUPPORTED;
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return is_colour() ? give(auto_white_balance_, data, size) : ONI_STATUS_NOT_SUPPORTED;
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus VirtualStream::setProperty(int id, const void* data, int size) {
  OniVideoMode mode{};
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      if (take(mode, data, size) != ONI_STATUS_OK || !same(mode, mode_)) return ONI_STATUS_BAD_PARAMETER;
      return ONI_STATUS_OK;
    case ONI_STREAM_PROPERTY_MIRRORING:
      return take(mirrored_, data, size);
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return is_colour() ? take(auto_exposure_, data, size) : ONI_STATUS_NOT_SUPPORTED;
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return is_colour() ? take(auto_white_balance_, data, size) : ONI_STATUS_NOT_SUPPORTED;
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniBool VirtualStream::isPropertySupported(int id) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
    case ONI_STREAM_PROPERTY_CROPPING:
    case ONI_STREAM_PROPERTY_MIRRORING:
    case ONI_STREAM_PROPERTY_MIN_VALUE:
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return 1;
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return is_colour() ? 1 : 0;
    default:
      return 0;
  }
}

void VirtualStream::deliver(const cv::Mat& picture, std::uint64_t time_us, int index) {
  OniFrame* frame = getServices().acquireFrame();
  if (frame == nullptr) return;
  const int row_bytes = mode_.resolutionX * static_cast<int>(picture.elemSize());
  cv::Mat target(mode_.resolutionY, mode_.resolutionX, picture.type(), frame->data);
  if (mirrored_ != 0) {
    cv::flip(picture, target, 1);
  } else {
    picture.copyTo(target);
  }
  frame->dataSize = row_bytes * mode_.resolutionY;
  frame->sensorType = sensor_;
  frame->timestamp = time_us;
  frame->frameIndex = index;
  frame->width = mode_.resolutionX;
  frame->height = mode_.resolutionY;
  frame->videoMode = mode_;
  frame->croppingEnabled = 0;
  frame->cropOriginX = frame->cropOriginY = 0;
  frame->stride = row_bytes;
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

}  // namespace cpslam::virtual_camera
