#include "slam/loop_verification.h"

#include <shared_mutex>

#include "slam/local_map.h"
#include "slam/loop_plausibility.h"
#include "slam/pose_refinement.h"
#include "slam/recovery.h"

namespace cpslam {
namespace {

// Of the points that should be visible. Occlusion and another light cost many; another place has few.
constexpr double kMinFoundShare = 0.25;

std::optional<Frame> frame_of(const Map& map, KeyFrameId id) {
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

}  // namespace

std::optional<VerifiedLoop> verify_loop(const Rig& rig, const Map& map, KeyFrameId current,
                                        KeyFrameId candidate, const IndexPair& indices, Random& random) {
  std::optional<Frame> frame = frame_of(map, current);
  if (!frame || recover_from_keyframe(rig, map, candidate, random, *frame, indices) == 0) return std::nullopt;
  LocalMap surroundings;
  surroundings.centre_on(map, candidate);
  // The rough pose first gathers more points in wide windows, then settles in narrow ones.
  (void)track_local_map(rig, surroundings, 3.0F, *frame);
  const LocalMapMatch match = track_local_map(rig, surroundings, 1.0F, *frame);
  const RefinedPose pose = refine_pose(rig, *frame);
  if (pose.map_points < rig.settings.loops.min_inliers || !is_well_determined(pose.covariance))
    return std::nullopt;
  if (pose.map_points < kMinFoundShare * static_cast<double>(match.expected.size())) return std::nullopt;

  VerifiedLoop loop;
  loop.edge = {current, candidate, frame->cam_from_world * surroundings.reference_from_world().inverse()};
  loop.matches = std::move(frame->matches);
  loop.inliers = pose.map_points;
  const std::shared_lock lock(map.mutex());
  if (map.keyframe(current) == nullptr || map.keyframe(candidate) == nullptr) return std::nullopt;
  if (!is_plausible(map, loop.edge)) return std::nullopt;
  return loop;
}

}  // namespace cpslam
