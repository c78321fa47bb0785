#pragma once

#include <vector>

#include "cpslam/types.h"
#include "map/map.h"

namespace cpslam {

/// Remembers every tracked frame by its pose relative to its reference keyframe, so that whatever later moves
/// the keyframe moves the frame with it. Not thread-safe.
class TrajectoryLog {
 public:
  void add(double time_s, KeyFrameId reference, const SE3& cam_from_reference) {
    entries_.push_back({time_s, reference, cam_from_reference});
  }
  /// Takes a shared lock of the map.
  [[nodiscard]] Trajectory resolve(const Map& map) const;

 private:
  struct Entry {
    double time_s;
    KeyFrameId reference;
    SE3 cam_from_reference;
  };
  std::vector<Entry> entries_;
};

/// Poses of the living keyframes by time. Takes a shared lock of the map.
[[nodiscard]] Trajectory keyframe_poses(const Map& map);

}  // namespace cpslam
