#include "map/map.h"

#include <algorithm>

namespace cpslam {

KeyFrameId Map::add_keyframe(KeyFrame keyframe) {
  keyframe.sequence = keyframes_created_++;
  keyframe.points.assign(static_cast<std::size_t>(keyframe.features->size()), MapPointId{});
  ++version_;
  const int session = keyframe.session;
  const KeyFrameId id = keyframes_.insert(std::move(keyframe));
  roots_.try_emplace(session, id);
  sessions_created_ = std::max(sessions_created_, session);
  return id;
}

void Map::set_pose(KeyFrameId id, const SE3& cam_from_world) {
  if (KeyFrame* keyframe = keyframes_.find(id)) {
    keyframe->cam_from_world = cam_from_world;
    ++version_;
  }
}

bool Map::erase_keyframe(KeyFrameId id) {
  KeyFrame* keyframe = keyframes_.find(id);
  if (keyframe == nullptr || !keyframe->parent.valid() || !keyframe->loops.empty()) return false;
  const std::vector<MapPointId> points = keyframe->points;
  for (const MapPointId point : points) {
    if (point.valid()) erase_observation(point, id);
  }
  for (const Covisible& edge : keyframe->covisible) erase_edge(edge.keyframe, id);
  adopt_children(id, *keyframe);
  KeyFrame& parent = *keyframes_.find(keyframe->parent);
  std::erase(parent.children, id);
  tombstones_[id] = {keyframe->parent, keyframe->cam_from_world * parent.cam_from_world.inverse()};
  keyframes_.erase(id);
  ++version_;
  return true;
}

std::optional<SE3> Map::cam_from_world(KeyFrameId id) const {
  SE3 cam_from_ancestor;
  for (;;) {
    if (const KeyFrame* keyframe = keyframes_.find(id)) return cam_from_ancestor * keyframe->cam_from_world;
    const auto tombstone = tombstones_.find(id);
    if (tombstone == tombstones_.end()) return std::nullopt;
    cam_from_ancestor = cam_from_ancestor * tombstone->second.cam_from_parent;
    id = tombstone->second.parent;
  }
}

KeyFrameId Map::living(KeyFrameId id) const {
  while (keyframes_.find(id) == nullptr) {
    const auto tombstone = tombstones_.find(id);
    if (tombstone == tombstones_.end()) return {};
    id = tombstone->second.parent;
  }
  return id;
}

std::vector<KeyFrameId> Map::keyframes_by_sequence() const {
  std::vector<std::pair<std::uint64_t, KeyFrameId>> order;
  keyframes_.for_each([&](KeyFrameId id, const KeyFrame& k) { order.emplace_back(k.sequence, id); });
  std::sort(order.begin(), order.end());
  std::vector<KeyFrameId> ids;
  ids.reserve(order.size());
  for (const auto& [sequence, id] : order) ids.push_back(id);
  return ids;
}

MapPointId Map::add_point(const Eigen::Vector3d& position_in_world, const Observation& first) {
  const KeyFrame* keyframe = keyframes_.find(first.keyframe);
  if (keyframe == nullptr) return {};
  MapPoint point;
  point.position_in_world = position_in_world;
  point.reference = first.keyframe;
  point.first_sequence = keyframe->sequence;
  const MapPointId id = points_.insert(std::move(point));
  if (!add_observation(id, first)) {
    points_.erase(id);
    return {};
  }
  refresh_point(id);
  ++points_created_;
  return id;
}

std::vector<MapPointId> Map::point_ids() const {
  std::vector<MapPointId> ids;
  ids.reserve(points_.size());
  points_.for_each([&](MapPointId id, const MapPoint&) { ids.push_back(id); });
  return ids;
}

void Map::set_position(MapPointId id, const Eigen::Vector3d& position_in_world) {
  if (MapPoint* point = points_.find(id)) {
    point->position_in_world = position_in_world;
    ++version_;
  }
}

void Map::count_visible(MapPointId id, bool found) {
  MapPoint* point = points_.find(id);
  if (point == nullptr) return;
  ++point->visible;
  if (found) ++point->found;
}

void Map::erase_point(MapPointId id) {
  MapPoint* point = points_.find(id);
  if (point == nullptr) return;
  for (const Observation& seen : point->observations) {
    keyframes_.find(seen.keyframe)->points[static_cast<std::size_t>(seen.keypoint)] = MapPointId{};
  }
  points_.erase(id);
  ++version_;
}

void Map::merge_points(MapPointId old, MapPointId kept) {
  MapPoint* dead = points_.find(old);
  MapPoint* heir = points_.find(kept);
  if (dead == nullptr || heir == nullptr || dead == heir) return;
  heir->visible += dead->visible;
  heir->found += dead->found;
  const std::vector<Observation> observations = dead->observations;
  erase_point(old);
  for (const Observation& seen : observations) add_observation(kept, seen);
  refresh_point(kept);
}

bool Map::add_observation(MapPointId point_id, const Observation& observation) {
  MapPoint* point = points_.find(point_id);
  KeyFrame* keyframe = keyframes_.find(observation.keyframe);
  if (point == nullptr || keyframe == nullptr) return false;
  MapPointId& slot = keyframe->points[static_cast<std::size_t>(observation.keypoint)];
  if (slot.valid() || keypoint_of(point_id, observation.keyframe) >= 0) return false;
  slot = point_id;
  point->observations.push_back(observation);
  ++version_;
  return true;
}

void Map::erase_observation(MapPointId point_id, KeyFrameId keyframe_id) {
  MapPoint* point = points_.find(point_id);
  if (point == nullptr) return;
  auto& observations = point->observations;
  const auto seen = std::find_if(observations.begin(), observations.end(),
                                 [&](const Observation& o) { return o.keyframe == keyframe_id; });
  if (seen == observations.end()) return;
  keyframes_.find(keyframe_id)->points[static_cast<std::size_t>(seen->keypoint)] = MapPointId{};
  observations.erase(seen);
  ++version_;
  const bool stands =
      observations.size() >= 2 ||
      (observations.size() == 1 &&
       keyframes_.find(observations[0].keyframe)
               ->features->depth_m[static_cast<std::size_t>(observations[0].keypoint)] > 0.0F);
  if (!stands) {
    erase_point(point_id);
  } else if (point->reference == keyframe_id) {
    point->reference = observations.front().keyframe;
    refresh_point(point_id);
  }
}

int Map::keypoint_of(MapPointId point_id, KeyFrameId keyframe_id) const {
  const MapPoint* point = points_.find(point_id);
  if (point == nullptr) return -1;
  for (const Observation& seen : point->observations) {
    if (seen.keyframe == keyframe_id) return seen.keypoint;
  }
  return -1;
}

void Map::refresh_points_of(KeyFrameId keyframe_id) {
  const KeyFrame* keyframe = keyframes_.find(keyframe_id);
  if (keyframe == nullptr) return;
  for (const MapPointId point : keyframe->points) {
    if (point.valid()) refresh_point(point);
  }
}

void Map::refresh_geometry(MapPointId id) {
  MapPoint* point = points_.find(id);
  if (point == nullptr || point->observations.empty()) return;
  Eigen::Vector3d direction_sum = Eigen::Vector3d::Zero();
  for (const Observation& seen : point->observations) {
    const KeyFrame& keyframe = *keyframes_.find(seen.keyframe);
    const Eigen::Vector3d ray = point->position_in_world - keyframe.centre_in_world();
    direction_sum += ray.normalized();
    if (seen.keyframe == point->reference) {
      const auto keypoint = static_cast<std::size_t>(seen.keypoint);
      const auto octave = static_cast<std::size_t>(keyframe.features->keypoints[keypoint].octave);
      point->max_distance_m = static_cast<float>(ray.norm()) * pyramid_.factor[octave];
      point->min_distance_m = point->max_distance_m / pyramid_.factor.back();
    }
  }
  point->normal = direction_sum.normalized();
}

void Map::refresh_point(MapPointId id) {
  refresh_geometry(id);
  MapPoint* point = points_.find(id);
  if (point == nullptr || point->observations.empty()) return;
  std::vector<const Descriptor*> descriptors;
  for (const Observation& seen : point->observations) {
    const FrameFeatures& features = *keyframes_.find(seen.keyframe)->features;
    descriptors.push_back(&features.descriptors[static_cast<std::size_t>(seen.keypoint)]);
  }
  // The medoid of the latest observations; more of them change nothing but the cost, which is quadratic.
  constexpr std::size_t kMaxCompared = 16;
  if (descriptors.size() > kMaxCompared) {
    descriptors.erase(descriptors.begin(), descriptors.end() - static_cast<std::ptrdiff_t>(kMaxCompared));
  }
  int best_sum = 0;
  const Descriptor* medoid = nullptr;
  for (const Descriptor* candidate : descriptors) {
    int sum = 0;
    for (const Descriptor* other : descriptors) sum += descriptor_distance(*candidate, *other);
    if (medoid == nullptr || sum < best_sum) {
      best_sum = sum;
      medoid = candidate;
    }
  }
  point->descriptor = *medoid;
}

}  // namespace cpslam
