#include "slam/loop_verification.h"

#include <shared_mutex>

#include "slam/keyframe_frame.h"
#include "slam/local_map.h"
#include "slam/loop_plausibility.h"
#include "slam/pose_refinement.h"
#include "slam/recovery.h"
#include "slam/session_agreement.h"

namespace cpslam {
namespace {

// Of the points that should be visible. Occlusion and another light cost many; another place has few.
constexpr double kMinFoundShare = 0.25;

/// Whether what else is known of the two ends lets the loop be.
bool is_credible(const Rig& rig, const Map& map, const LoopEdge& loop) {
  {
    const std::shared_lock lock(map.mutex());
    const KeyFrame* current = map.keyframe(loop.current);
    const KeyFrame* matched = map.keyframe(loop.matched);
    if (current == nullptr || matched == nullptr) return false;
    if (current->session == matched->session) return is_plausible(map, loop);
  }
  return is_enough(compare_sessions(rig, map, loop));
}

}  // namespace

std::optional<VerifiedLoop> verify_loop(const Rig& rig, const Map& map, KeyFrameId current,
                                        KeyFrameId candidate, const IndexPair& indices, Random& random) {
  std::optional<Frame> frame = keyframe_as_frame(map, current);
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
  if (!is_credible(rig, map, loop.edge)) return std::nullopt;
  return loop;
}

}  // namespace cpslam
