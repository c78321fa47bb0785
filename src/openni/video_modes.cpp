#include "openni/video_modes.h"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "cpslam/error.h"

namespace cpslam {
namespace {

/// The best first.
constexpr std::array kFormats{openni::PIXEL_FORMAT_RGB888,     openni::PIXEL_FORMAT_YUYV,
                              openni::PIXEL_FORMAT_YUV422,     openni::PIXEL_FORMAT_GRAY8,
                              openni::PIXEL_FORMAT_DEPTH_1_MM, openni::PIXEL_FORMAT_DEPTH_100_UM};

auto rank(const openni::VideoMode& mode) {
  return std::find(kFormats.begin(), kFormats.end(), mode.getPixelFormat());
}

std::string offered_text(const openni::Array<openni::VideoMode>& modes) {
  std::set<std::tuple<int, int, int>> offered;
  for (int i = 0; i < modes.getSize(); ++i) {
    if (rank(modes[i]) == kFormats.end()) continue;
    offered.emplace(modes[i].getResolutionX(), modes[i].getResolutionY(), modes[i].getFps());
  }
  std::string text;
  for (const auto& [width, height, fps] : offered)
    text += (text.empty() ? "" : ", ") + mode_text(width, height, fps);
  return text.empty() ? "nothing that can be read" : text;
}

}  // namespace

std::string mode_text(int width, int height, int fps) {
  return std::to_string(width) + "x" + std::to_string(height) + " at " + std::to_string(fps) + "/s";
}

openni::VideoMode choose_mode(const openni::SensorInfo& sensor, const std::string& what, int width,
                              int height, int fps) {
  const openni::Array<openni::VideoMode>& modes = sensor.getSupportedVideoModes();
  const openni::VideoMode* best = nullptr;
  for (int i = 0; i < modes.getSize(); ++i) {
    const openni::VideoMode& mode = modes[i];
    const bool fits =
        mode.getResolutionX() == width && mode.getResolutionY() == height && mode.getFps() == fps;
    if (!fits || rank(mode) == kFormats.end()) continue;
    if (best == nullptr || rank(mode) < rank(*best)) best = &mode;
  }
  if (best != nullptr) return *best;
  throw InputError("the camera has no " + what + " images of " + mode_text(width, height, fps) +
                   "; it offers " + offered_text(modes) + " (--resolution, --fps)");
}

double units_per_metre(openni::PixelFormat format) {
  switch (format) {
    case openni::PIXEL_FORMAT_DEPTH_1_MM:
      return 1e3;
    case openni::PIXEL_FORMAT_DEPTH_100_UM:
      return 1e4;
    default:
      return 0.0;
  }
}

}  // namespace cpslam
