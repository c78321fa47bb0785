#include "slam/keyframe_frame.h"

#include <shared_mutex>

namespace cpslam {

std::optional<Frame> keyframe_as_frame(const Map& map, KeyFrameId id) {
  const std::shared_lock lock(map.mutex());
  const KeyFrame* keyframe = map.keyframe(id);
  if (keyframe == nullptr) return std::nullopt;
  Frame frame;
  frame.time_s = keyframe->time_s;
  frame.features = keyframe->features;
  frame.cam_from_world = keyframe->cam_from_world;
  frame.matches.resize(keyframe->points.size());
  return frame;
}

}  // namespace cpslam
