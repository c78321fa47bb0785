#include "slam/keyframe_inserter.h"

#include <algorithm>
#include <mutex>

#include "slam/observation_model.h"

namespace cpslam {
namespace {

constexpr std::size_t kMinPointsWithDepth = 300;

/// Keypoints that shall carry a point of their own depth: all close ones, or the nearest kMinPointsWithDepth.
std::vector<int> keypoints_for_depth_points(const Rig& rig, const FrameFeatures& features) {
  std::vector<std::pair<float, int>> by_depth;
  for (int i = 0; i < features.size(); ++i) {
    if (const float depth_m = features.depth_m[static_cast<std::size_t>(i)]; depth_m > 0.0F) {
      by_depth.emplace_back(depth_m, i);
    }
  }
  std::sort(by_depth.begin(), by_depth.end());
  std::vector<int> chosen;
  for (const auto& [depth_m, i] : by_depth) {
    if (depth_m > rig.close_depth_m && chosen.size() >= kMinPointsWithDepth) break;
    chosen.push_back(i);
  }
  return chosen;
}

/// That of the reference keyframe; without one a new one.
int session_of(const Map& map, const Placement& placement) {
  const int session = map.session_of(placement.reference);
  return session != 0 ? session : map.sessions_created() + 1;
}

}  // namespace

KeyFrameId insert_keyframe(const Rig& rig, Map& map, const Placement& placement, Frame& frame) {
  const std::vector<int> with_depth = keypoints_for_depth_points(rig, *frame.features);

  const std::unique_lock lock(map.mutex());
  if (const auto reference_from_world = map.cam_from_world(placement.reference)) {
    frame.cam_from_world =
        frame.cam_from_world * placement.reference_from_world.inverse() * *reference_from_world;
  }
  const SE3 world_from_cam = frame.cam_from_world.inverse();
  KeyFrame keyframe;
  keyframe.session = session_of(map, placement);
  keyframe.time_s = frame.time_s;
  keyframe.cam_from_world = frame.cam_from_world;
  keyframe.features = frame.features;
  const KeyFrameId id = map.add_keyframe(std::move(keyframe));
  for (std::size_t i = 0; i < frame.matches.size(); ++i) {
    PointMatch& match = frame.matches[i];
    if (match.kind == PointMatch::Kind::kMapPoint &&
        !map.add_observation(match.id, {id, static_cast<int>(i)})) {
      match = {};  // erased by the mapper since it was matched
    }
  }
  for (const int i : with_depth) {
    PointMatch& match = frame.matches[static_cast<std::size_t>(i)];
    if (match.kind == PointMatch::Kind::kMapPoint) continue;
    const Eigen::Vector3d position = world_from_cam * back_project(rig, *frame.features, i);
    match = {PointMatch::Kind::kMapPoint, map.add_point(position, {id, i}), position};
  }
  map.update_covisibility(id);
  return id;
}

}  // namespace cpslam
