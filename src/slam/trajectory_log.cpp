#include "slam/trajectory_log.h"

#include <shared_mutex>

namespace cpslam {

Trajectory TrajectoryLog::resolve(const Map& map) const {
  const std::shared_lock lock(map.mutex());
  Trajectory trajectory;
  trajectory.reserve(frames_.size() - n_earlier_);
  for (std::size_t i = n_earlier_; i < frames_.size(); ++i) {
    const LoggedFrame& frame = frames_[i];
    if (const auto reference_from_world = map.cam_from_world(frame.reference)) {
      const SE3 cam_from_world = frame.cam_from_reference * *reference_from_world;
      trajectory.push_back(
          {frame.time_s, to_pose(cam_from_world.inverse()), map.session_of(frame.reference)});
    }
  }
  return trajectory;
}

Trajectory keyframe_poses(const Map& map, std::uint64_t first_sequence) {
  const std::shared_lock lock(map.mutex());
  Trajectory trajectory;
  for (const KeyFrameId id : map.keyframes_by_sequence()) {
    const KeyFrame& keyframe = *map.keyframe(id);
    if (keyframe.sequence < first_sequence) continue;
    trajectory.push_back({keyframe.time_s, to_pose(keyframe.cam_from_world.inverse()), keyframe.session});
  }
  return trajectory;
}

}  // namespace cpslam
