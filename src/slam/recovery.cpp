#include "slam/recovery.h"

#include <algorithm>
#include <numeric>
#include <shared_mutex>

#include "match/orb_matcher.h"
#include "slam/pose_ransac.h"
#include "slam/pose_refinement.h"

namespace cpslam {
namespace {

constexpr std::size_t kMinMatches = 12;
constexpr int kMinInliers = 12;
constexpr std::size_t kNeighbours = 2;
constexpr std::size_t kLatest = 2;
constexpr std::size_t kAlike = 5;

struct KeyFramePoints {
  std::shared_ptr<const FrameFeatures> features;
  std::vector<int> keypoints;
  std::vector<PointMatch> points;  // by keypoint index
};

KeyFramePoints copy_points(const Map& map, KeyFrameId id) {
  const std::shared_lock lock(map.mutex());
  KeyFramePoints copied;
  const KeyFrame* keyframe = map.keyframe(id);
  if (keyframe == nullptr) return copied;
  copied.features = keyframe->features;
  copied.points.resize(keyframe->points.size());
  for (std::size_t i = 0; i < keyframe->points.size(); ++i) {
    const MapPoint* point = map.point(keyframe->points[i]);
    if (point == nullptr) continue;
    copied.keypoints.push_back(static_cast<int>(i));
    copied.points[i] = {PointMatch::Kind::kMapPoint, keyframe->points[i], point->position_in_world};
  }
  return copied;
}

}  // namespace

int recover_from_keyframe(const Rig& rig, const Map& map, KeyFrameId keyframe, Random& random, Frame& frame,
                          const std::optional<IndexPair>& indices) {
  frame.matches.assign(frame.matches.size(), PointMatch{});
  const KeyFramePoints known = copy_points(map, keyframe);
  if (known.keypoints.size() < kMinMatches) return 0;
  std::vector<int> all(static_cast<std::size_t>(frame.features->size()));
  std::iota(all.begin(), all.end(), 0);
  MatchOptions options;
  options.max_distance = kStrictDistance;
  options.ratio = 0.85F;
  options.check_rotation = true;
  const KeypointSet in_frame{*frame.features, all};
  const KeypointSet in_keyframe{*known.features, known.keypoints};
  const std::vector<KeypointMatch> pairs = indices ? match_by_words(in_frame, in_keyframe, *indices, options)
                                                   : match_by_appearance(in_frame, in_keyframe, options);
  if (pairs.size() < kMinMatches) return 0;
  std::vector<PoseHypothesisMatch> hypotheses;
  hypotheses.reserve(pairs.size());
  for (const KeypointMatch& pair : pairs) {
    hypotheses.push_back({pair.a, known.points[static_cast<std::size_t>(pair.b)].position_in_world});
  }
  const auto pose = ransac_pose(rig, *frame.features, hypotheses, kMinMatches, random);
  if (!pose) return 0;
  frame.cam_from_world = pose->cam_from_world;
  for (const std::size_t i : pose->inliers) {
    frame.matches[static_cast<std::size_t>(pairs[i].a)] = known.points[static_cast<std::size_t>(pairs[i].b)];
  }
  const int inliers = refine_pose(rig, frame).map_points;
  if (inliers >= kMinInliers) return inliers;
  frame.matches.assign(frame.matches.size(), PointMatch{});
  return 0;
}

std::vector<KeyFrameId> recovery_candidates(const Map& map, const Places* places, KeyFrameId reference,
                                            const BowVector& bow) {
  std::vector<KeyFrameId> candidates;
  const auto add = [&](KeyFrameId id) {
    if (id.valid() && std::find(candidates.begin(), candidates.end(), id) == candidates.end()) {
      candidates.push_back(id);
    }
  };
  {
    const std::shared_lock lock(map.mutex());
    const KeyFrameId centre = map.living(reference);
    add(centre);
    const std::vector<KeyFrameId> all = map.keyframes_by_sequence();
    for (std::size_t i = 0; i < std::min(kLatest, all.size()); ++i) add(all[all.size() - 1 - i]);
    for (const KeyFrameId id : map.best_covisible(centre, kNeighbours)) add(id);
  }
  if (places == nullptr) return candidates;
  PlaceQuery query;
  query.max_candidates = kAlike;
  for (const PlaceCandidate& alike : places->database.candidates(map, bow, query)) add(alike.keyframe);
  return candidates;
}

}  // namespace cpslam
