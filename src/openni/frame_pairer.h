#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "openni/camera_frame.h"

namespace cpslam {

/// How far apart colour and depth of one frame may be: half an interval, and no further than the pairs that
/// associate_sequence() makes of a recording.
[[nodiscard]] double pair_tolerance_s(double frames_per_s);

/// Brings each colour image together with the depth image whose stamp is nearest, less than the tolerance
/// away. Pictures of each kind come in the order in which they were taken. Not thread-safe.
class FramePairer {
 public:
  explicit FramePairer(double tolerance_s);

  /// The frame that the picture completes, if any.
  [[nodiscard]] std::optional<CameraFrame> add_colour(CameraPicture picture);
  [[nodiscard]] std::optional<CameraFrame> add_depth(CameraPicture picture);

  /// Colour images that have gone without depth.
  [[nodiscard]] std::size_t unpaired() const { return unpaired_; }

 private:
  /// Takes the partner out of the queue, and all that came before it.
  std::optional<CameraPicture> take_partner(std::deque<CameraPicture>& queue, std::uint64_t time_us);

  const std::uint64_t tolerance_us_;
  std::deque<CameraPicture> colours_, depths_;  // waiting for a partner
  std::size_t unpaired_ = 0;
};

}  // namespace cpslam
