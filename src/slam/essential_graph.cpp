#include "slam/essential_graph.h"

#include <map>

namespace cpslam {
namespace {

constexpr int kStrongCovisibility = 100;  // shared points
// How well two keyframes that see the same things lie to each other. Only the ratio matters as long as all
// edges have the same: at a depth of 2 m, a turn of 5 mrad shows as much as a shift of 1 cm.
constexpr double kSigmaM = 0.01;
constexpr double kSigmaRad = 0.005;

class Builder {
 public:
  Builder(const Map& map, int session) : map_(map) {
    information_.setZero();
    information_.diagonal().head<3>().setConstant(1.0 / (kSigmaM * kSigmaM));
    information_.diagonal().tail<3>().setConstant(1.0 / (kSigmaRad * kSigmaRad));
    for (const KeyFrameId id : map.keyframes_by_sequence()) {
      if (map.keyframe(id)->session != session) continue;
      index_.emplace(id, static_cast<int>(result_.keyframes.size()));
      result_.keyframes.push_back(id);
      result_.graph.cam_from_world.push_back(map.keyframe(id)->cam_from_world);
      result_.graph.pose_fixed.push_back(map.is_root(id) ? 1 : 0);
    }
  }

  EssentialGraph build(const LoopEdge& loop) {
    for (const KeyFrameId id : result_.keyframes) add_edges_of(id);
    add(loop.matched, loop.current, loop.current_from_matched);
    return std::move(result_);
  }

 private:
  /// Every edge once: from the later keyframe.
  void add_edges_of(KeyFrameId id) {
    const KeyFrame& keyframe = *map_.keyframe(id);
    if (keyframe.parent.valid()) add_as_is(keyframe.parent, id);
    const auto is_tree_edge = [&](KeyFrameId other) {
      return other == keyframe.parent || map_.keyframe(other)->parent == id;
    };
    const auto is_later = [&](KeyFrameId other) {
      return map_.keyframe(other)->sequence > keyframe.sequence;
    };
    for (const KeyFrameId other : keyframe.loops) {
      if (!is_later(other) && !is_tree_edge(other)) add_as_is(other, id);
    }
    for (const Covisible& edge : keyframe.covisible) {
      if (edge.shared_points < kStrongCovisibility) break;  // most shared points first
      if (!is_later(edge.keyframe) && !is_tree_edge(edge.keyframe)) add_as_is(edge.keyframe, id);
    }
  }

  void add_as_is(KeyFrameId a, KeyFrameId b) {
    add(a, b, map_.keyframe(b)->cam_from_world * map_.keyframe(a)->cam_from_world.inverse());
  }

  void add(KeyFrameId a, KeyFrameId b, const SE3& b_from_a) {
    result_.graph.edges.push_back({index_.at(a), index_.at(b), b_from_a, information_});
  }

  const Map& map_;
  Eigen::Matrix<double, 6, 6> information_;
  EssentialGraph result_;
  std::map<KeyFrameId, int> index_;
};

}  // namespace

EssentialGraph essential_graph(const Map& map, const LoopEdge& loop) {
  return Builder(map, map.keyframe(loop.current)->session).build(loop);
}

}  // namespace cpslam
