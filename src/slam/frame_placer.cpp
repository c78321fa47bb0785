#include "slam/frame_placer.h"

#include <algorithm>
#include <memory>
#include <shared_mutex>
#include <utility>

#include "slam/motion_tracker.h"
#include "slam/place_evidence.h"
#include "slam/recovery.h"

namespace cpslam {
namespace {

// Half search windows around the predicted pose, px at level 0; the wider ones only when the narrower failed.
constexpr float kMotionWindowsPx[] = {15.0F, 30.0F, 60.0F};
// A frame that keeps less than this share of the last one's inliers may have been placed by chance:
// repetitive furniture gives some dozen consistent matches almost anywhere.
constexpr double kSuspiciousShare = 0.3;
// A place that is recognised without knowing where the camera was needs more than one that follows from the
// frame before: so many times Tracking.minInliers points, and PlaceEvidence.
constexpr int kRecognisedInliers = 2;
// At the map's rim its points are few and far: so many times as many of the last frame's tell more.
constexpr int kMoreByLastFrame = 2;

bool are_neighbours(const Map& map, KeyFrameId a, KeyFrameId b) {
  const std::shared_lock lock(map.mutex());
  const KeyFrame* keyframe = map.keyframe(a);
  if (keyframe == nullptr) return false;
  const auto is_b = [b](const Covisible& edge) { return edge.keyframe == b; };
  return a == b || std::any_of(keyframe->covisible.begin(), keyframe->covisible.end(), is_b);
}

}  // namespace

std::optional<Placement> FramePlacer::place(const PlacementPrior& prior, Frame& frame) {
  std::optional<Placement> moved = by_motion(prior, frame);
  const bool few = prior.may_bridge && is_few(moved);
  if (moved && !few && moved->inliers >= kSuspiciousShare * prior.last_inliers) return moved;
  // Who was carried while the lens was covered meets furniture of the same kind near the old pose, too.
  if (moved && prior.was_lost && !place_evidence(rig_, local_map_, frame).is_convincing()) moved.reset();
  // A second opinion. Where it is no better (a person steps in front of the camera), the first one stands.
  std::optional<Recognised> recognised = by_appearance(frame);
  if (!recognised || (moved && recognised->placement.inliers <= moved->inliers))
    return few ? by_last_frame(prior, std::move(moved), frame) : moved;
  frame = std::move(recognised->frame);
  local_map_ = std::move(recognised->local_map);
  return std::move(recognised->placement);
}

bool FramePlacer::is_few(const std::optional<Placement>& moved) const {
  return !moved || moved->inliers < kRecognisedInliers * rig_.settings.tracking.min_inliers;
}

Placement FramePlacer::place_keyframe(KeyFrameId keyframe, const Placement& placement) {
  local_map_.centre_on(map_, keyframe);
  return {
      placement.inliers, {}, local_map_.reference(), local_map_.reference_from_world(), placement.covariance};
}

std::optional<Placement> FramePlacer::by_motion(const PlacementPrior& prior, Frame& frame) {
  for (const float radius_px : kMotionWindowsPx) {
    {
      const auto scope = timer_.time("track: motion");
      frame.cam_from_world = prior.predicted_cam_from_world;
      if (track_from_last_frame(rig_, prior.last, radius_px, frame) == 0) continue;
    }
    if (auto placement = in_local_map(1.0F, local_map_, frame)) return placement;
  }
  return std::nullopt;
}

std::optional<Placement> FramePlacer::by_last_frame(const PlacementPrior& prior,
                                                    std::optional<Placement> moved, Frame& frame) {
  const auto scope = timer_.time("track: bridging");
  const int fewest = moved ? kMoreByLastFrame * moved->inliers : rig_.settings.tracking.min_inliers;
  Frame carried = frame;
  for (const float radius_px : kMotionWindowsPx) {
    carried.cam_from_world = prior.predicted_cam_from_world;
    const int inliers = track_from_last_frame(rig_, prior.last, radius_px, carried);
    if (inliers < fewest) continue;
    frame = std::move(carried);
    Placement placement{inliers, {}, local_map_.reference(), local_map_.reference_from_world()};
    placement.bridged = true;
    return placement;
  }
  return moved;
}

std::optional<FramePlacer::Recognised> FramePlacer::by_appearance(const Frame& frame) {
  const auto scope = timer_.time("track: recovery");
  ImageWords words;
  if (places_ != nullptr) words = places_->vocabulary.transform(frame.features->descriptors);
  // Not the first that will do: another desk of the same kind agrees with a few dozen points, too.
  std::optional<Recognised> best;
  for (const KeyFrameId keyframe : recovery_candidates(map_, places_, local_map_.reference(), words.bow)) {
    if (best && are_neighbours(map_, keyframe, best->placement.reference)) continue;
    std::optional<Recognised> recognised = by_keyframe(keyframe, words, frame);
    if (!recognised || (best && recognised->placement.inliers <= best->placement.inliers)) continue;
    best = std::move(recognised);
  }
  return best;
}

std::optional<FramePlacer::Recognised> FramePlacer::by_keyframe(KeyFrameId keyframe, const ImageWords& words,
                                                                const Frame& frame) {
  std::shared_ptr<const ImageWords> its_words;
  if (places_ != nullptr) its_words = places_->database.words(keyframe);
  std::optional<IndexPair> indices;
  if (its_words) indices.emplace(IndexPair{words.features, its_words->features});
  Recognised recognised;
  recognised.frame = frame;
  if (recover_from_keyframe(rig_, map_, keyframe, random_, recognised.frame, indices) == 0)
    return std::nullopt;
  // The rough pose first gathers more points in wide windows, then settles in narrow ones.
  (void)in_local_map(3.0F, recognised.local_map, recognised.frame);
  std::optional<Placement> placement = in_local_map(1.0F, recognised.local_map, recognised.frame);
  if (!placement || placement->inliers < kRecognisedInliers * rig_.settings.tracking.min_inliers)
    return std::nullopt;
  if (!place_evidence(rig_, recognised.local_map, recognised.frame).is_convincing()) return std::nullopt;
  recognised.placement = *std::move(placement);
  return recognised;
}

std::optional<Placement> FramePlacer::in_local_map(float window, LocalMap& local_map, Frame& frame) {
  {
    const auto scope = timer_.time("track: local map update");
    local_map.update(map_, frame);
  }
  const auto scope = timer_.time("track: local map");
  LocalMapMatch match = track_local_map(rig_, local_map, window, frame);
  if (match.inliers < rig_.settings.tracking.min_inliers) return std::nullopt;
  return Placement{match.inliers, std::move(match.expected), local_map.reference(),
                   local_map.reference_from_world(), match.covariance};
}

}  // namespace cpslam
