#include "slam/keyframe_culling.h"

#include <mutex>
#include <shared_mutex>

namespace cpslam {
namespace {

constexpr double kRedundantShare = 0.9;
constexpr int kOtherViews = 3;

bool is_redundant(const Rig& rig, const Map& map, KeyFrameId id) {
  const KeyFrame* keyframe = map.keyframe(id);
  if (keyframe == nullptr || !keyframe->parent.valid()) return false;
  int points = 0;
  int redundant = 0;
  for (std::size_t i = 0; i < keyframe->points.size(); ++i) {
    const MapPoint* point = map.point(keyframe->points[i]);
    const double depth_m = keyframe->features->depth_m[i];
    if (point == nullptr || depth_m <= 0.0 || depth_m > rig.close_depth_m) continue;
    ++points;
    const int octave = keyframe->features->keypoints[i].octave;
    int others = 0;
    for (const Observation& seen : point->observations) {
      if (seen.keyframe == id) continue;
      const FrameFeatures& features = *map.keyframe(seen.keyframe)->features;
      if (features.keypoints[static_cast<std::size_t>(seen.keypoint)].octave <= octave + 1) ++others;
    }
    if (others >= kOtherViews) ++redundant;
  }
  return redundant > kRedundantShare * points;
}

}  // namespace

std::vector<KeyFrameId> cull_keyframes(const Rig& rig, Map& map, KeyFrameId around) {
  std::vector<KeyFrameId> neighbours;
  {
    const std::shared_lock lock(map.mutex());
    const KeyFrame* keyframe = map.keyframe(around);
    if (keyframe == nullptr) return {};
    neighbours = map.best_covisible(around, keyframe->covisible.size());
  }
  std::vector<KeyFrameId> culled;
  for (const KeyFrameId id : neighbours) {
    // One lock for the question and the act: the answer changes with every keyframe freed.
    const std::unique_lock lock(map.mutex());
    if (is_redundant(rig, map, id) && map.erase_keyframe(id)) culled.push_back(id);
  }
  return culled;
}

}  // namespace cpslam
