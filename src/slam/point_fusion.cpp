#include "slam/point_fusion.h"

#include <algorithm>
#include <mutex>
#include <shared_mutex>

#include "match/orb_matcher.h"
#include "slam/observation_model.h"
#include "slam/point_snapshot.h"

namespace cpslam {
namespace {

constexpr std::size_t kNeighbours = 10;
constexpr std::size_t kSecondNeighbours = 5;
constexpr SearchWindow kWindow{3.0F, 3.0F};

struct Target {
  SE3 cam_from_world;
  std::shared_ptr<const FrameFeatures> features;
};

std::vector<KeyFrameId> fusion_neighbours(const Map& map, KeyFrameId id) {
  std::vector<KeyFrameId> neighbours;
  const auto add = [&](KeyFrameId other) {
    if (other != id && std::find(neighbours.begin(), neighbours.end(), other) == neighbours.end()) {
      neighbours.push_back(other);
    }
  };
  for (const KeyFrameId first : map.best_covisible(id, kNeighbours)) add(first);
  for (std::size_t i = 0, n = neighbours.size(); i < n; ++i) {
    for (const KeyFrameId second : map.best_covisible(neighbours[i], kSecondNeighbours)) add(second);
  }
  return neighbours;
}

/// Points of the sources, each once, but for those the target sees already.
std::vector<PointSnapshot> candidates_for(const Map& map, const std::vector<KeyFrameId>& sources,
                                          KeyFrameId target) {
  std::vector<MapPointId> ids;
  for (const KeyFrameId source : sources) {
    if (const KeyFrame* keyframe = map.keyframe(source)) {
      std::copy_if(keyframe->points.begin(), keyframe->points.end(), std::back_inserter(ids),
                   [](MapPointId id) { return id.valid(); });
    }
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<PointSnapshot> candidates;
  for (const MapPointId id : ids) {
    const MapPoint* point = map.point(id);
    if (point == nullptr || map.keypoint_of(id, target) >= 0) continue;
    candidates.emplace_back(id, *point);
  }
  return candidates;
}

struct Fusion {
  MapPointId point;
  int keypoint;
};

std::vector<Fusion> find_fusions(const Rig& rig, const std::vector<PointSnapshot>& candidates,
                                 const Target& target) {
  const Eigen::Vector3d centre = target.cam_from_world.inverse().translation;
  std::vector<ProjectionQuery> queries;
  std::vector<const PointSnapshot*> sources;
  for (const PointSnapshot& candidate : candidates) {
    const auto query = expect_point(rig, candidate, target.cam_from_world, centre, kWindow);
    if (!query) continue;
    queries.push_back(*query);
    sources.push_back(&candidate);
  }
  MatchOptions options;
  options.max_distance = kStrictDistance;
  const std::vector<int> found = match_by_projection(*target.features, queries, {}, options);
  std::vector<Fusion> fusions;
  for (std::size_t q = 0; q < found.size(); ++q) {
    if (found[q] < 0) continue;
    const PointObservation seen = observe(rig, *target.features, found[q]);
    if (chi2(rig, seen, target.cam_from_world * sources[q]->position_in_world) < chi2_gate(seen)) {
      fusions.push_back({sources[q]->id, found[q]});
    }
  }
  return fusions;
}

void apply(Map& map, KeyFrameId target, const std::vector<Fusion>& fusions) {
  for (const Fusion& fusion : fusions) {
    const KeyFrame* keyframe = map.keyframe(target);
    const MapPoint* point = map.point(fusion.point);
    if (keyframe == nullptr || point == nullptr) continue;
    const MapPointId present = keyframe->points[static_cast<std::size_t>(fusion.keypoint)];
    const MapPoint* other = map.point(present);
    if (other == nullptr) {
      map.add_observation(fusion.point, {target, fusion.keypoint});
    } else if (other->observations.size() > point->observations.size()) {
      map.merge_points(fusion.point, present);
    } else {
      map.merge_points(present, fusion.point);
    }
  }
}

void fuse_into(const Rig& rig, Map& map, const std::vector<KeyFrameId>& sources, KeyFrameId target_id) {
  Target target;
  std::vector<PointSnapshot> candidates;
  {
    const std::shared_lock lock(map.mutex());
    const KeyFrame* keyframe = map.keyframe(target_id);
    if (keyframe == nullptr) return;
    target = {keyframe->cam_from_world, keyframe->features};
    candidates = candidates_for(map, sources, target_id);
  }
  const std::vector<Fusion> fusions = find_fusions(rig, candidates, target);
  const std::unique_lock lock(map.mutex());
  apply(map, target_id, fusions);
}

}  // namespace

void fuse_between(const Rig& rig, Map& map, const std::vector<KeyFrameId>& sources,
                  const std::vector<KeyFrameId>& targets) {
  for (const KeyFrameId target : targets) fuse_into(rig, map, sources, target);
}

void fuse_points(const Rig& rig, Map& map, KeyFrameId keyframe) {
  std::vector<KeyFrameId> neighbours;
  {
    const std::shared_lock lock(map.mutex());
    neighbours = fusion_neighbours(map, keyframe);
  }
  fuse_between(rig, map, {keyframe}, neighbours);
  fuse_between(rig, map, neighbours, {keyframe});
  const std::unique_lock lock(map.mutex());
  map.refresh_points_of(keyframe);
  map.update_covisibility(keyframe);
}

}  // namespace cpslam
