#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "map/map_builder.h"

/// Random maps, and what must hold for every map.
namespace cpslam::test {

inline constexpr std::size_t kMonkeyKeypoints = 60;

inline void check_links(const Map& map) {
  std::set<MapPointId> reached;
  for (const KeyFrameId id : map.keyframes_by_sequence()) {
    const KeyFrame& keyframe = *map.keyframe(id);
    ASSERT_EQ(keyframe.points.size(), static_cast<std::size_t>(keyframe.features->size()));
    for (std::size_t i = 0; i < keyframe.points.size(); ++i) {
      if (!keyframe.points[i].valid()) continue;
      const MapPoint* point = map.point(keyframe.points[i]);
      ASSERT_NE(point, nullptr) << "a keyframe sees a point that is gone";
      ASSERT_EQ(map.keypoint_of(keyframe.points[i], id), static_cast<int>(i));
      reached.insert(keyframe.points[i]);
    }
  }
  ASSERT_EQ(reached.size(), map.n_points()) << "a point that nobody sees";
  for (const MapPointId id : reached) {
    std::set<KeyFrameId> seen_by;
    bool reference_sees = false;
    for (const Observation& seen : map.point(id)->observations) {
      const KeyFrame* keyframe = map.keyframe(seen.keyframe);
      ASSERT_NE(keyframe, nullptr);
      ASSERT_EQ(keyframe->points[static_cast<std::size_t>(seen.keypoint)], id);
      ASSERT_TRUE(seen_by.insert(seen.keyframe).second) << "two observations in one keyframe";
      reference_sees = reference_sees || seen.keyframe == map.point(id)->reference;
    }
    ASSERT_TRUE(reference_sees);
  }
}

inline void check_covisibility(const Map& map) {
  for (const KeyFrameId id : map.keyframes_by_sequence()) {
    const auto& edges = map.keyframe(id)->covisible;
    std::set<KeyFrameId> neighbours;
    for (const Covisible& edge : edges) {
      ASSERT_NE(edge.keyframe, id);
      ASSERT_NE(map.keyframe(edge.keyframe), nullptr);
      ASSERT_TRUE(neighbours.insert(edge.keyframe).second);
      ASSERT_EQ(shared_points_of_edge(map, edge.keyframe, id), edge.shared_points);
    }
    ASSERT_TRUE(std::is_sorted(edges.begin(), edges.end(), [&](const Covisible& a, const Covisible& b) {
      if (a.shared_points != b.shared_points) return a.shared_points > b.shared_points;
      return map.keyframe(a.keyframe)->sequence < map.keyframe(b.keyframe)->sequence;
    }));
  }
}

/// A tree rooted at the first keyframe, and perhaps others rooted where a keyframe shared nothing.
inline void check_tree(const Map& map, KeyFrameId root, bool single) {
  const auto ids = map.keyframes_by_sequence();
  std::size_t children = 0;
  std::size_t roots = 0;
  for (const KeyFrameId id : ids) {
    const KeyFrame& keyframe = *map.keyframe(id);
    for (const KeyFrameId child : keyframe.children) {
      ASSERT_NE(map.keyframe(child), nullptr);
      ASSERT_EQ(map.keyframe(child)->parent, id);
    }
    children += keyframe.children.size();
    KeyFrameId ancestor = id;
    for (std::size_t steps = 0; map.keyframe(ancestor)->parent.valid(); ++steps) {
      ASSERT_LT(steps, ids.size()) << "a cycle";
      ancestor = map.keyframe(ancestor)->parent;
      ASSERT_NE(map.keyframe(ancestor), nullptr);
    }
    if (ancestor == id) ++roots;
    if (single) {
      ASSERT_EQ(ancestor, root);
    }
  }
  ASSERT_FALSE(map.keyframe(root)->parent.valid());
  ASSERT_EQ(children + roots, ids.size()) << "every keyframe is a root or the child of exactly one";
}

inline void check_count(const Map& map, KeyFrameId id) {
  std::map<KeyFrameId, int> shared;
  for (const MapPointId point : map.keyframe(id)->points) {
    if (!point.valid()) continue;
    for (const Observation& seen : map.point(point)->observations) {
      if (seen.keyframe != id) ++shared[seen.keyframe];
    }
  }
  int best = 0;
  for (const auto& [other, n] : shared) best = std::max(best, n);
  std::size_t edges = 0;
  for (const auto& [other, n] : shared) {
    const int counted = shared_points_of_edge(map, id, other);
    if (n >= 15) {
      ASSERT_EQ(counted, n);
    } else {
      ASSERT_TRUE(counted == 0 || (counted == n && n == best));
    }
    edges += counted > 0 ? 1U : 0U;
  }
  ASSERT_EQ(edges > 0, !shared.empty());
  ASSERT_EQ(edges, map.keyframe(id)->covisible.size());
}

/// Does something at random to a map.
class Monkey {
 public:
  Monkey(std::uint64_t seed, bool lonely) : random_(seed), lonely_(lonely) {
    add_keyframe(map, blank_features(kMonkeyKeypoints));
    root = map.keyframes_by_sequence().front();
    for (int i = 0; i < 50; ++i) add_point();
  }

  void act() {
    const double dice = random_.uniform();
    if (dice < 0.30) return add_point();
    if (dice < 0.65) return observe(any_keyframe());
    if (dice < 0.71) return map.merge_points(any_point(), any_point());
    if (dice < 0.77) return map.erase_point(any_point());
    if (dice < 0.85) return map.erase_observation(any_point(), any_keyframe());
    if (dice < 0.90) {
      const KeyFrameId id = any_keyframe();
      map.update_covisibility(id);
      return check_count(map, id);
    }
    if (dice < 0.96) return insert();
    cull();
  }

  Map map{synthetic::pyramid()};
  KeyFrameId root;
  std::vector<KeyFrameId> culled;

 private:
  KeyFrameId any_keyframe() {
    const auto ids = map.keyframes_by_sequence();
    return ids[random_.index(ids.size())];
  }
  int any_keypoint() { return static_cast<int>(random_.index(kMonkeyKeypoints)); }
  MapPointId any_point() {  // sometimes one that is gone or none at all
    if (!gone_.empty() && random_.uniform() < 0.05) return gone_[random_.index(gone_.size())];
    const MapPointId id = map.keyframe(any_keyframe())->points[static_cast<std::size_t>(any_keypoint())];
    if (id.valid()) gone_.push_back(id);
    return id;
  }
  void add_point() {
    const Eigen::Vector3d position(random_.uniform(), random_.uniform(), 2.0);
    map.add_point(position, {any_keyframe(), any_keypoint()});
  }
  void observe(KeyFrameId id) { map.add_observation(any_point(), {id, any_keypoint()}); }

  void insert() {
    if (map.n_keyframes() > 25) return;
    const bool depth = random_.uniform() < 0.5;
    const SE3 pose(so3_exp({0.0, random_.uniform(), 0.0}), {random_.uniform(), 0.0, 0.0});
    const KeyFrameId id = add_keyframe(map, blank_features(kMonkeyKeypoints, depth), pose);
    if (!lonely_ || random_.uniform() < 0.7) {
      while (map.count_points(id, 2) < 5) observe(id);
      for (int i = 0; i < 60; ++i) observe(id);
    }
    map.update_covisibility(id);
    check_count(map, id);
  }
  void cull() {
    if (map.n_keyframes() < 5) return;
    const KeyFrameId id = any_keyframe();
    const bool has_parent = map.keyframe(id)->parent.valid();
    ASSERT_EQ(map.erase_keyframe(id), has_parent);
    if (has_parent) culled.push_back(id);
  }

  Random random_;
  const bool lonely_;  // makes keyframes that share nothing
  std::vector<MapPointId> gone_;
};

}  // namespace cpslam::test
