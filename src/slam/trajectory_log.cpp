#include "slam/trajectory_log.h"

#include <shared_mutex>

namespace cpslam {

Trajectory TrajectoryLog::resolve(const Map& map) const {
  const std::shared_lock lock(map.mutex());
  Trajectory trajectory;
  trajectory.reserve(entries_.size());
  for (const Entry& entry : entries_) {
    if (const auto reference_from_world = map.cam_from_world(entry.reference)) {
      const SE3 cam_from_world = entry.cam_from_reference * *reference_from_world;
      trajectory.push_back({entry.time_s, to_pose(cam_from_world.inverse())});
    }
  }
  return trajectory;
}

Trajectory keyframe_poses(const Map& map) {
  const std::shared_lock lock(map.mutex());
  Trajectory trajectory;
  for (const KeyFrameId id : map.keyframes_by_sequence()) {
    const KeyFrame& keyframe = *map.keyframe(id);
    trajectory.push_back({keyframe.time_s, to_pose(keyframe.cam_from_world.inverse())});
  }
  return trajectory;
}

}  // namespace cpslam
