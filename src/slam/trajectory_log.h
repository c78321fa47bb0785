#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "cpslam/types.h"
#include "map/map.h"

namespace cpslam {

/// A tracked frame by its pose relative to its reference keyframe.
struct LoggedFrame {
  double time_s = 0.0;
  KeyFrameId reference;
  SE3 cam_from_reference;
};

/// Remembers every tracked frame by its pose relative to its reference keyframe, so that whatever later moves
/// the keyframe moves the frame with it. Not thread-safe.
class TrajectoryLog {
 public:
  /// earlier: the frames that a loaded map was made of.
  explicit TrajectoryLog(std::vector<LoggedFrame> earlier = {})
      : frames_(std::move(earlier)), n_earlier_(frames_.size()) {}

  void add(double time_s, KeyFrameId reference, const SE3& cam_from_reference) {
    frames_.push_back({time_s, reference, cam_from_reference});
  }
  /// All frames, the earlier ones first.
  [[nodiscard]] const std::vector<LoggedFrame>& frames() const { return frames_; }
  /// Poses of the frames added here. Takes a shared lock of the map.
  [[nodiscard]] Trajectory resolve(const Map& map) const;

 private:
  std::vector<LoggedFrame> frames_;
  std::size_t n_earlier_;
};

/// Poses of the living keyframes by time, from one of this KeyFrame::sequence on. Takes a shared lock of the
/// map.
[[nodiscard]] Trajectory keyframe_poses(const Map& map, std::uint64_t first_sequence = 0);

}  // namespace cpslam
