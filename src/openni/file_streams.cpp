#include "openni/file_streams.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "cpslam/error.h"
#include "openni/picture_conversion.h"

namespace cpslam {
namespace {

constexpr double kMaxPatienceMs = 1e6;

}  // namespace

FileStreams::FileStreams(RgbdDevice& device)
    : device_(device),
      left_(device.n_pictures(device.colour()) + device.n_pictures(device.depth())),
      pairer_(pair_tolerance_s(device.settings().fps)) {
  device_.start();
}

CameraEvent FileStreams::next(CameraFrame& frame, std::chrono::duration<double> patience,
                              const std::stop_token& stop) {
  // In the order in which they lie in the file: asking for a picture beyond one of the other stream, or
  // beyond the end, would wait for ever.
  std::array<openni::VideoStream*, 2> streams{&device_.colour(), &device_.depth()};
  const int patience_ms = static_cast<int>(std::min(1e3 * patience.count(), kMaxPatienceMs));
  for (; left_ > 0; --left_) {
    if (stop.stop_requested()) return CameraEvent::kStopped;
    int ready = -1;
    if (openni::OpenNI::waitForAnyStream(streams.data(), 2, &ready, patience_ms) != openni::STATUS_OK)
      return CameraEvent::kStalled;
    openni::VideoFrameRef raw;
    if (streams.at(static_cast<std::size_t>(ready))->readFrame(&raw) != openni::STATUS_OK || !raw.isValid())
      throw RunError(device_.name() + " breaks off: " + openni_error());
    const bool colour = ready == 0;
    CameraPicture picture =
        copy_picture(raw, device_.mirrored(colour ? openni::SENSOR_COLOR : openni::SENSOR_DEPTH));
    std::optional<CameraFrame> pair =
        colour ? pairer_.add_colour(std::move(picture)) : pairer_.add_depth(std::move(picture));
    if (!pair) continue;
    frame = *std::move(pair);
    --left_;
    return CameraEvent::kFrame;
  }
  return CameraEvent::kEnd;
}

CameraCounts FileStreams::counts() const {
  CameraCounts counts;
  counts.unpaired = pairer_.unpaired();
  return counts;
}

}  // namespace cpslam
