#include "slam/frame_placer.h"

#include <utility>

#include "slam/motion_tracker.h"
#include "slam/recovery.h"

namespace cpslam {
namespace {

// Half search windows around the predicted pose, px at level 0; the wider ones only when the narrower failed.
constexpr float kMotionWindowsPx[] = {15.0F, 30.0F, 60.0F};
// A frame that keeps less than this share of the last one's inliers may have been placed by chance:
// repetitive furniture gives some dozen consistent matches almost anywhere.
constexpr double kSuspiciousShare = 0.3;

}  // namespace

std::optional<Placement> FramePlacer::place(const PlacementPrior& prior, Frame& frame) {
  std::optional<Placement> moved = by_motion(prior, frame);
  if (moved && moved->inliers >= kSuspiciousShare * prior.last_inliers) return moved;
  // A second opinion. Where it is no better (a person steps in front of the camera), the first one stands.
  Frame other = frame;
  std::optional<Placement> recognised = by_appearance(prior, other);
  if (!recognised || (moved && recognised->inliers <= moved->inliers)) return moved;
  frame = std::move(other);
  return recognised;
}

Placement FramePlacer::place_keyframe(KeyFrameId keyframe, int inliers) {
  local_map_.centre_on(map_, keyframe);
  return {inliers, {}, local_map_.reference(), local_map_.reference_from_world()};
}

std::optional<Placement> FramePlacer::by_motion(const PlacementPrior& prior, Frame& frame) {
  for (const float radius_px : kMotionWindowsPx) {
    {
      const auto scope = timer_.time("track: motion");
      frame.cam_from_world = prior.predicted_cam_from_world;
      if (track_from_last_frame(rig_, prior.last, radius_px, frame) == 0) continue;
    }
    if (auto placement = in_local_map(1.0F, frame)) return placement;
  }
  return std::nullopt;
}

std::optional<Placement> FramePlacer::by_appearance(const PlacementPrior& prior, Frame& frame) {
  const auto scope = timer_.time("track: recovery");
  for (const KeyFrameId keyframe :
       recovery_candidates(map_, local_map_.reference(), prior.frames_without_pose)) {
    if (recover_from_keyframe(rig_, map_, keyframe, random_, frame) == 0) continue;
    // The rough pose first gathers more points in wide windows, then settles in narrow ones.
    (void)in_local_map(3.0F, frame);
    if (auto placement = in_local_map(1.0F, frame)) return placement;
  }
  return std::nullopt;
}

std::optional<Placement> FramePlacer::in_local_map(float window, Frame& frame) {
  {
    const auto scope = timer_.time("track: local map update");
    local_map_.update(map_, frame);
  }
  const auto scope = timer_.time("track: local map");
  LocalMapMatch match = track_local_map(rig_, local_map_, window, frame);
  if (match.inliers < rig_.settings.tracking.min_inliers) return std::nullopt;
  return Placement{match.inliers, std::move(match.expected), local_map_.reference(),
                   local_map_.reference_from_world()};
}

}  // namespace cpslam
