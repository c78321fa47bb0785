// The sessions of Map: maps in worlds of their own, until a loop connects them.
#include <algorithm>
#include <utility>

#include "map/map.h"

namespace cpslam {

std::vector<int> Map::sessions() const {
  std::vector<int> numbers;
  numbers.reserve(roots_.size());
  for (const auto& [number, root] : roots_) numbers.push_back(number);
  return numbers;
}

int Map::session_of(KeyFrameId id) const {
  const KeyFrame* keyframe = keyframes_.find(living(id));
  return keyframe != nullptr ? keyframe->session : 0;
}

bool Map::is_root(KeyFrameId id) const {
  const KeyFrame* keyframe = keyframes_.find(id);
  return keyframe != nullptr && roots_.at(keyframe->session) == id;
}

int Map::join_sessions(KeyFrameId a, KeyFrameId b, const SE3& a_from_b) {
  const KeyFrame* first = keyframes_.find(a);
  const KeyFrame* second = keyframes_.find(b);
  if (first == nullptr || second == nullptr || first->session == second->session) return 0;
  const auto root_sequence = [this](int session) { return keyframes_.find(roots_.at(session))->sequence; };
  if (root_sequence(first->session) > root_sequence(second->session))
    return join_sessions(b, a, a_from_b.inverse());
  const int stays = first->session;
  const int goes = second->session;
  const SE3 first_world_from_second = first->cam_from_world.inverse() * a_from_b * second->cam_from_world;
  move_session(goes, stays, first_world_from_second);
  make_root(b);
  keyframes_.find(b)->parent = a;
  keyframes_.find(a)->children.push_back(b);
  roots_.erase(goes);
  return goes;
}

void Map::move_session(int session, int to, const SE3& new_from_old) {
  const SE3 old_from_new = new_from_old.inverse();
  keyframes_.for_each([&](KeyFrameId, KeyFrame& keyframe) {
    if (keyframe.session == session)
      keyframe.cam_from_world = (keyframe.cam_from_world * old_from_new).normalized();
  });
  points_.for_each([&](MapPointId id, MapPoint& point) {
    if (keyframes_.find(point.reference)->session != session) return;
    point.position_in_world = new_from_old * point.position_in_world;
    refresh_geometry(id);
  });
  keyframes_.for_each([&](KeyFrameId, KeyFrame& keyframe) {
    if (keyframe.session == session) keyframe.session = to;
  });
  ++version_;
}

void Map::make_root(KeyFrameId id) {
  KeyFrameId child;
  while (id.valid()) {
    KeyFrame& keyframe = *keyframes_.find(id);
    const KeyFrameId parent = std::exchange(keyframe.parent, child);
    if (child.valid()) std::erase(keyframe.children, child);
    if (parent.valid()) keyframe.children.push_back(parent);
    child = id;
    id = parent;
  }
}

}  // namespace cpslam
