#include "slam/session_agreement.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <shared_mutex>
#include <vector>

#include "slam/keyframe_frame.h"
#include "slam/local_map.h"
#include "slam/place_evidence.h"

namespace cpslam {
namespace {

// Two views from so near, and so little turned against each other, show the same things or are of two places.
constexpr double kBesideM = 0.7;
constexpr double kBesideRad = 0.5;
// A turn by one radian changes what is seen about as much as a metre does.
constexpr double kMetresPerRadian = 1.0;
constexpr std::size_t kMostCompared = 30;

// Of the points that should be visible: right ones had 0.24 to 0.5, those of an identical desk 0.31 to 0.49,
// its surroundings next to none (docs/benchmarks.md).
constexpr double kAgreeingShare = 0.2;
constexpr double kContradictingShare = 0.12;
constexpr std::ptrdiff_t kFewestExpected = 60;

constexpr int kMinAgreeing = 4;
constexpr int kAgreeingPerContradicting = 10;
// What one piece of furniture shows of itself from all sides that a camera in front of it gets to is less.
constexpr double kMinSpanM = 2.0;

struct Stand {
  KeyFrameId keyframe;
  SE3 cam_from_world;
};

double way_m(const SE3& a, const SE3& b) {
  const Eigen::Vector3d apart = a.inverse().translation - b.inverse().translation;
  return apart.norm() + kMetresPerRadian * rotation_angle(a.rotation * b.rotation.transpose());
}

bool is_beside(const SE3& a, const SE3& b) {
  return (a.inverse().translation - b.inverse().translation).norm() < kBesideM &&
         rotation_angle(a.rotation * b.rotation.transpose()) < kBesideRad;
}

/// A keyframe of the one session and the nearest of the other one's beside it.
struct Pair {
  Stand here;  // in the other session's world
  KeyFrameId there;
};

std::vector<Stand> stands_of(const Map& map, int session, const SE3& old_from_new) {
  std::vector<Stand> stands;
  for (const KeyFrameId id : map.keyframes_by_sequence()) {
    const KeyFrame& keyframe = *map.keyframe(id);
    if (keyframe.session == session) stands.push_back({id, keyframe.cam_from_world * old_from_new});
  }
  return stands;
}

std::vector<Pair> pairs_beside(const Map& map, const LoopEdge& loop) {
  const std::shared_lock lock(map.mutex());
  const KeyFrame* current = map.keyframe(loop.current);
  const KeyFrame* matched = map.keyframe(loop.matched);
  if (current == nullptr || matched == nullptr) return {};
  const SE3 here_from_there =
      current->cam_from_world.inverse() * loop.current_from_matched * matched->cam_from_world;
  const std::vector<Stand> theirs = stands_of(map, matched->session, {});
  std::vector<Pair> pairs;
  for (const Stand& here : stands_of(map, current->session, here_from_there)) {
    std::optional<std::pair<double, KeyFrameId>> nearest;
    for (const Stand& there : theirs) {
      if (!is_beside(here.cam_from_world, there.cam_from_world)) continue;
      const double m = way_m(here.cam_from_world, there.cam_from_world);
      if (!nearest || m < nearest->first) nearest = {m, there.keyframe};
    }
    if (nearest) pairs.push_back({here, nearest->second});
  }
  return pairs;
}

/// Some of many, as evenly as it goes.
std::vector<Pair> thinned(const std::vector<Pair>& pairs) {
  if (pairs.size() <= kMostCompared) return pairs;
  std::vector<Pair> some;
  for (std::size_t i = 0; i < kMostCompared; ++i) some.push_back(pairs[i * pairs.size() / kMostCompared]);
  return some;
}

enum class Verdict { kAgrees, kContradicts, kNeither };

Verdict compare(const Rig& rig, const Map& map, const Pair& pair) {
  std::optional<Frame> frame = keyframe_as_frame(map, pair.here.keyframe);
  if (!frame) return Verdict::kNeither;
  frame->cam_from_world = pair.here.cam_from_world;
  LocalMap around;
  around.centre_on(map, pair.there);
  // Both sessions have drifted a little: wide windows first.
  (void)track_local_map(rig, around, 3.0F, *frame);
  const LocalMapMatch match = track_local_map(rig, around, 1.0F, *frame);
  const PlaceEvidence evidence = place_evidence(rig, around, *frame);
  if (evidence.found_share >= kAgreeingShare && match.inliers >= rig.settings.loops.min_inliers)
    return Verdict::kAgrees;
  const bool contradicts =
      evidence.found_share < kContradictingShare && evidence.n_expected >= kFewestExpected;
  return contradicts ? Verdict::kContradicts : Verdict::kNeither;
}

}  // namespace

SessionAgreement compare_sessions(const Rig& rig, const Map& map, const LoopEdge& loop) {
  SessionAgreement agreement;
  std::vector<SE3> agreeing;
  for (const Pair& pair : thinned(pairs_beside(map, loop))) {
    const Verdict verdict = compare(rig, map, pair);
    if (verdict == Verdict::kContradicts) ++agreement.contradicting;
    if (verdict == Verdict::kAgrees) agreeing.push_back(pair.here.cam_from_world);
  }
  agreement.agreeing = static_cast<int>(agreeing.size());
  for (const SE3& a : agreeing) {
    for (const SE3& b : agreeing) agreement.span_m = std::max(agreement.span_m, way_m(a, b));
  }
  return agreement;
}

bool is_enough(const SessionAgreement& agreement) {
  return agreement.agreeing >= kMinAgreeing &&
         agreement.agreeing >= kAgreeingPerContradicting * agreement.contradicting &&
         agreement.span_m >= kMinSpanM;
}

}  // namespace cpslam
