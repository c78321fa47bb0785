// The covisibility graph and the spanning tree of Map.
#include <algorithm>

#include "map/map.h"

namespace cpslam {
namespace {

// Fewer shared points than this make no edge, unless there is no better one (Mur-Artal et al. 2015, III-D).
constexpr int kMinSharedPoints = 15;

bool fewer(const std::pair<const KeyFrameId, int>& a, const std::pair<const KeyFrameId, int>& b) {
  return a.second < b.second;
}

}  // namespace

std::map<KeyFrameId, int> Map::count_shared(KeyFrameId id) const {
  std::map<KeyFrameId, int> shared;
  for (const MapPointId point_id : keyframes_.find(id)->points) {
    const MapPoint* point = points_.find(point_id);
    if (point == nullptr) continue;
    for (const Observation& seen : point->observations) {
      if (seen.keyframe != id) ++shared[seen.keyframe];
    }
  }
  return shared;
}

void Map::add_edges(KeyFrameId id, const std::map<KeyFrameId, int>& shared) {
  const auto best = std::max_element(shared.begin(), shared.end(), fewer);
  for (const auto& [other, count] : shared) {
    if (count < kMinSharedPoints && other != best->first) continue;
    add_edge(id, other, count);
    add_edge(other, id, count);
  }
}

void Map::update_covisibility(KeyFrameId id) {
  KeyFrame* keyframe = keyframes_.find(id);
  if (keyframe == nullptr) return;
  std::map<KeyFrameId, int> shared = count_shared(id);
  for (const Covisible& edge : keyframe->covisible) {
    const auto still = shared.find(edge.keyframe);
    if (still == shared.end() || still->second < kMinSharedPoints) erase_edge(edge.keyframe, id);
  }
  keyframe->covisible.clear();
  add_edges(id, shared);
  if (is_root(id) || keyframe->parent.valid()) return;
  // One that shared nothing when it came may have descendants by now: none of them can be its parent.
  std::erase_if(shared, [&](const auto& other) { return descends_from(other.first, id); });
  if (const auto parent = std::max_element(shared.begin(), shared.end(), fewer); parent != shared.end()) {
    keyframe->parent = parent->first;
    keyframes_.find(parent->first)->children.push_back(id);
  }
}

bool Map::descends_from(KeyFrameId id, KeyFrameId ancestor) const {
  while (id.valid() && id != ancestor) id = keyframes_.find(id)->parent;
  return id == ancestor;
}

void Map::add_edge(KeyFrameId from, KeyFrameId to, int shared_points) {
  auto& edges = keyframes_.find(from)->covisible;
  erase_edge(from, to);
  const auto before = [this](const Covisible& a, const Covisible& b) {
    if (a.shared_points != b.shared_points) return a.shared_points > b.shared_points;
    return keyframes_.find(a.keyframe)->sequence < keyframes_.find(b.keyframe)->sequence;
  };
  const Covisible edge{to, shared_points};
  edges.insert(std::lower_bound(edges.begin(), edges.end(), edge, before), edge);
}

void Map::erase_edge(KeyFrameId from, KeyFrameId to) {
  std::erase_if(keyframes_.find(from)->covisible, [&](const Covisible& edge) { return edge.keyframe == to; });
}

void Map::adopt_children(KeyFrameId orphaned_by, const KeyFrame& dead) {
  // A child goes to the candidate it shares most points with; a child that found a parent is itself a
  // candidate for the others, which keeps the tree free of cycles. What shares nothing goes to the
  // grandparent.
  std::vector<KeyFrameId> orphans = dead.children;
  std::vector<KeyFrameId> candidates{dead.parent};
  while (!orphans.empty()) {
    KeyFrameId best_child = orphans.front();
    KeyFrameId best_parent = dead.parent;
    int best_shared = -1;
    for (const KeyFrameId child : orphans) {
      for (const Covisible& edge : keyframes_.find(child)->covisible) {
        const bool allowed =
            std::find(candidates.begin(), candidates.end(), edge.keyframe) != candidates.end();
        if (edge.keyframe != orphaned_by && allowed && edge.shared_points > best_shared) {
          best_shared = edge.shared_points;
          best_child = child;
          best_parent = edge.keyframe;
        }
      }
    }
    keyframes_.find(best_child)->parent = best_parent;
    keyframes_.find(best_parent)->children.push_back(best_child);
    candidates.push_back(best_child);
    std::erase(orphans, best_child);
  }
}

void Map::add_loop_edge(KeyFrameId a, KeyFrameId b) {
  KeyFrame* first = keyframes_.find(a);
  KeyFrame* second = keyframes_.find(b);
  if (first == nullptr || second == nullptr || a == b) return;
  if (std::find(first->loops.begin(), first->loops.end(), b) != first->loops.end()) return;
  first->loops.push_back(b);
  second->loops.push_back(a);
}

std::vector<KeyFrameId> Map::best_covisible(KeyFrameId id, std::size_t n) const {
  std::vector<KeyFrameId> best;
  if (const KeyFrame* keyframe = keyframes_.find(id)) {
    for (const Covisible& edge : keyframe->covisible) {
      if (best.size() == n) break;
      best.push_back(edge.keyframe);
    }
  }
  return best;
}

int Map::count_points(KeyFrameId id, std::size_t min_observations) const {
  const KeyFrame* keyframe = keyframes_.find(id);
  if (keyframe == nullptr) return 0;
  return static_cast<int>(
      std::count_if(keyframe->points.begin(), keyframe->points.end(), [&](MapPointId point_id) {
        const MapPoint* point = points_.find(point_id);
        return point != nullptr && point->observations.size() >= min_observations;
      }));
}

}  // namespace cpslam
