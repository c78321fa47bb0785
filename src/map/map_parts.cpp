// A map taken apart, and put together again.
#include "map/map_parts.h"

#include <algorithm>

#include "map/map.h"

namespace cpslam {
namespace {

std::vector<KeyFrameId> keyframes_of(const Map& map, int session) {
  std::vector<KeyFrameId> ids = map.keyframes_by_sequence();
  std::erase_if(ids, [&](KeyFrameId id) { return map.keyframe(id)->session != session; });
  return ids;
}

/// Positions of the keyframes in their order, by slot.
std::vector<std::uint32_t> positions_by_slot(const std::vector<KeyFrameId>& order) {
  std::vector<std::uint32_t> positions;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t slot = order[i].index;
    if (slot >= positions.size()) positions.resize(slot + 1, MapParts::kNone);
    positions[slot] = static_cast<std::uint32_t>(i);
  }
  return positions;
}

MapParts::PointPart take_point(const MapPoint& point, const std::vector<std::uint32_t>& position_of) {
  MapParts::PointPart part;
  part.position_in_world = point.position_in_world;
  part.observations.reserve(point.observations.size());
  for (const Observation& seen : point.observations) {
    part.observations.push_back(
        {position_of[seen.keyframe.index], static_cast<std::uint32_t>(seen.keypoint)});
  }
  part.reference = position_of[point.reference.index];
  part.first_sequence = point.first_sequence;
  part.visible = static_cast<std::uint32_t>(point.visible);
  part.found = static_cast<std::uint32_t>(point.found);
  return part;
}

}  // namespace

MapParts take_apart(const Map& map, int session) {
  const std::vector<KeyFrameId> order = keyframes_of(map, session);
  const std::vector<std::uint32_t> position_of = positions_by_slot(order);
  MapParts parts;
  parts.keyframes.reserve(order.size());
  for (const KeyFrameId id : order) {
    const KeyFrame& keyframe = *map.keyframe(id);
    const std::uint32_t parent =
        keyframe.parent.valid() ? position_of[keyframe.parent.index] : MapParts::kNone;
    const auto here = static_cast<std::uint32_t>(parts.keyframes.size());
    parts.keyframes.push_back(
        {keyframe.sequence, keyframe.time_s, keyframe.cam_from_world, keyframe.features, parent});
    for (const KeyFrameId other : keyframe.loops) {
      if (const std::uint32_t there = position_of[other.index]; there > here) {
        parts.loops.emplace_back(here, there);
      }
    }
  }
  for (const MapPointId id : map.point_ids()) {
    const MapPoint& point = *map.point(id);
    if (map.keyframe(point.reference)->session == session)
      parts.points.push_back(take_point(point, position_of));
  }
  parts.keyframes_created = map.keyframes_created();
  parts.points_created = map.points_created();
  return parts;
}

std::vector<KeyFrameId> Map::assemble(const MapParts& parts) {
  const int session = ++sessions_created_;
  std::vector<KeyFrameId> ids;
  ids.reserve(parts.keyframes.size());
  for (const MapParts::KeyFramePart& part : parts.keyframes) {
    KeyFrame keyframe;
    keyframe.session = session;
    keyframe.sequence = part.sequence;
    keyframe.time_s = part.time_s;
    keyframe.cam_from_world = part.cam_from_world;
    keyframe.features = part.features;
    keyframe.points.assign(static_cast<std::size_t>(part.features->size()), MapPointId{});
    ids.push_back(keyframes_.insert(std::move(keyframe)));
  }
  roots_.emplace(session, ids.front());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (parts.keyframes[i].parent == MapParts::kNone) continue;
    const KeyFrameId parent = ids[parts.keyframes[i].parent];
    keyframes_.find(ids[i])->parent = parent;
    keyframes_.find(parent)->children.push_back(ids[i]);
  }
  for (const auto& [a, b] : parts.loops) add_loop_edge(ids[a], ids[b]);
  for (const MapParts::PointPart& part : parts.points) assemble_point(part, ids);
  for (const KeyFrameId id : ids) add_edges(id, count_shared(id));
  keyframes_created_ = std::max(keyframes_created_, parts.keyframes_created);
  points_created_ = std::max(points_created_, parts.points_created);
  ++version_;
  return ids;
}

void Map::assemble_point(const MapParts::PointPart& part, const std::vector<KeyFrameId>& ids) {
  MapPoint point;
  point.position_in_world = part.position_in_world;
  point.reference = ids[part.reference];
  point.first_sequence = part.first_sequence;
  point.visible = static_cast<int>(part.visible);
  point.found = static_cast<int>(part.found);
  const MapPointId id = points_.insert(std::move(point));
  for (const MapParts::ObservationPart& seen : part.observations) {
    add_observation(id, {ids[seen.keyframe], static_cast<int>(seen.keypoint)});
  }
  refresh_point(id);
}

}  // namespace cpslam
