#include "slam/map_snapshot.h"

#include <algorithm>
#include <optional>
#include <shared_mutex>
#include <utility>

#include "geometry/world_point.h"

namespace cpslam {
namespace {

/// Where the living keyframes stand in the snapshot.
class Ranks {
 public:
  explicit Ranks(const std::vector<KeyFrameId>& ids) {
    ranks_.reserve(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) ranks_.emplace_back(ids[i], static_cast<std::uint32_t>(i));
    std::sort(ranks_.begin(), ranks_.end());
  }
  [[nodiscard]] std::optional<std::uint32_t> of(KeyFrameId id) const {
    const auto at = std::lower_bound(ranks_.begin(), ranks_.end(), std::pair(id, std::uint32_t{0}));
    if (at == ranks_.end() || at->first != id) return std::nullopt;
    return at->second;
  }

 private:
  std::vector<std::pair<KeyFrameId, std::uint32_t>> ranks_;
};

/// Every edge once, though both ends know of it.
void add_edges(const KeyFrame& keyframe, std::uint32_t from, const Ranks& ranks, MapSnapshot& snapshot) {
  for (const Covisible& edge : keyframe.covisible) {
    if (edge.shared_points < MapSnapshot::kStrongEdge) break;  // the strongest come first
    if (const auto to = ranks.of(edge.keyframe); to && *to < from)
      snapshot.covisibility.push_back({from, *to});
  }
  if (const auto parent = ranks.of(keyframe.parent)) snapshot.spanning_tree.push_back({from, *parent});
  for (const KeyFrameId other : keyframe.loops) {
    if (const auto to = ranks.of(other); to && *to < from) snapshot.loops.push_back({from, *to});
  }
}

}  // namespace

MapSnapshot copy_for_viewer(const Map& map, int session) {
  MapSnapshot snapshot;
  snapshot.map = session;
  const std::shared_lock lock(map.mutex());
  snapshot.corrections = map.corrections();
  const std::vector<MapPointId> points = map.point_ids();
  snapshot.points.reserve(points.size());
  for (const MapPointId id : points) {
    const MapPoint& point = *map.point(id);
    if (map.keyframe(point.reference)->session == session)
      snapshot.points.push_back(to_world_point(point.position_in_world));
  }
  std::vector<KeyFrameId> keyframes = map.keyframes_by_sequence();
  std::erase_if(keyframes, [&](KeyFrameId id) { return map.keyframe(id)->session != session; });
  const Ranks ranks(keyframes);
  snapshot.keyframes.reserve(keyframes.size());
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const KeyFrame& keyframe = *map.keyframe(keyframes[i]);
    snapshot.keyframes.push_back({keyframe.time_s, to_pose(keyframe.cam_from_world.inverse()), session});
    add_edges(keyframe, static_cast<std::uint32_t>(i), ranks, snapshot);
  }
  return snapshot;
}

}  // namespace cpslam
