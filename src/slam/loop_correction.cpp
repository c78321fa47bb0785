#include "slam/loop_correction.h"

#include <mutex>
#include <shared_mutex>
#include <vector>

#include "slam/map_correction.h"
#include "slam/point_fusion.h"

namespace cpslam {
namespace {

constexpr std::size_t kNeighbours = 10;  // of either end take part in the fusion

std::optional<EssentialGraph> copy_graph(const Map& map, const LoopEdge& loop, ClosedLoop& error) {
  const std::shared_lock lock(map.mutex());
  const KeyFrame* current = map.keyframe(loop.current);
  const KeyFrame* matched = map.keyframe(loop.matched);
  if (current == nullptr || matched == nullptr) return std::nullopt;
  const SE3 present = current->cam_from_world * matched->cam_from_world.inverse();
  error.distance_m = (loop.current_from_matched.inverse().translation - present.inverse().translation).norm();
  error.angle_rad = rotation_angle(loop.current_from_matched.rotation * present.rotation.transpose());
  return essential_graph(map, loop);
}

bool connects_sessions(const Map& map, const LoopEdge& loop) {
  const std::shared_lock lock(map.mutex());
  const KeyFrame* current = map.keyframe(loop.current);
  const KeyFrame* matched = map.keyframe(loop.matched);
  return current != nullptr && matched != nullptr && current->session != matched->session;
}

ClosedLoop join(Map& map, const LoopEdge& loop, StageTimer& timer) {
  const auto scope = timer.time("loop: moving the map");
  const std::unique_lock lock(map.mutex());
  ClosedLoop closed;
  closed.joined_session = map.join_sessions(loop.current, loop.matched, loop.current_from_matched);
  map.add_loop_edge(loop.current, loop.matched);
  map.count_correction();
  return closed;
}

void move_map(Map& map, const EssentialGraph& graph, const LoopEdge& loop) {
  MapCorrection correction;
  for (std::size_t i = 0; i < graph.keyframes.size(); ++i) {
    correction.cam_from_world.emplace(graph.keyframes[i], graph.graph.cam_from_world[i]);
  }
  const std::unique_lock lock(map.mutex());
  apply_correction(map, correction);
  map.add_loop_edge(loop.current, loop.matched);
}

/// The points that verification found in the current keyframe: they take the places of its own.
void adopt_matches(Map& map, const VerifiedLoop& loop) {
  const std::unique_lock lock(map.mutex());
  for (std::size_t i = 0; i < loop.matches.size(); ++i) {
    const KeyFrame* current = map.keyframe(loop.edge.current);
    if (current == nullptr) return;
    const MapPointId found = loop.matches[i].id;
    if (loop.matches[i].kind != PointMatch::Kind::kMapPoint || map.point(found) == nullptr) continue;
    if (current->points[i].valid()) {
      map.merge_points(current->points[i], found);
    } else {
      map.add_observation(found, {loop.edge.current, static_cast<int>(i)});
    }
  }
}

std::vector<KeyFrameId> surroundings(const Map& map, KeyFrameId centre) {
  const std::shared_lock lock(map.mutex());
  std::vector<KeyFrameId> ids = map.best_covisible(centre, kNeighbours);
  ids.insert(ids.begin(), centre);
  return ids;
}

void fuse_sides(const Rig& rig, Map& map, const VerifiedLoop& loop) {
  // Before they share points, or each would be among the other's neighbours.
  const std::vector<KeyFrameId> current = surroundings(map, loop.edge.current);
  const std::vector<KeyFrameId> matched = surroundings(map, loop.edge.matched);
  adopt_matches(map, loop);
  fuse_between(rig, map, matched, current);
  fuse_between(rig, map, current, matched);
  for (const std::vector<KeyFrameId>* side : {&current, &matched}) {
    for (const KeyFrameId id : *side) {
      const std::unique_lock lock(map.mutex());
      map.refresh_points_of(id);
      map.update_covisibility(id);
    }
  }
}

std::optional<ClosedLoop> bend(Map& map, const LoopEdge& loop, StageTimer& timer,
                               const std::atomic<bool>& abort) {
  ClosedLoop closed;
  std::optional<EssentialGraph> graph;
  {
    const auto scope = timer.time("loop: pose graph");
    graph = copy_graph(map, loop, closed);
    if (!graph) return std::nullopt;
    PoseGraphOptions options;
    options.abort = &abort;
    optimize_pose_graph(graph->graph, options);
  }
  if (abort) return std::nullopt;
  const auto scope = timer.time("loop: moving the map");
  move_map(map, *graph, loop);
  return closed;
}

}  // namespace

std::optional<ClosedLoop> close_loop(const Rig& rig, Map& map, const VerifiedLoop& loop, StageTimer& timer,
                                     const std::atomic<bool>& abort) {
  if (abort) return std::nullopt;
  const std::optional<ClosedLoop> closed =
      connects_sessions(map, loop.edge) ? join(map, loop.edge, timer) : bend(map, loop.edge, timer, abort);
  if (!closed) return std::nullopt;
  const auto scope = timer.time("loop: fusion");
  fuse_sides(rig, map, loop);
  return closed;
}

}  // namespace cpslam
