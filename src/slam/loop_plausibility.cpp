#include "slam/loop_plausibility.h"

#include <queue>
#include <set>
#include <utility>
#include <vector>

namespace cpslam {
namespace {

// A turn by one radian lets as much drift in as half a metre on the way.
constexpr double kMetresPerRadian = 0.5;
// Several times what RGB-D odometry drifts, with people in the picture too (docs/benchmarks.md: rings of 35 m
// end some 0.1 m off), and far below the distance of two places that somebody could mix up.
constexpr double kLeastErrorM = 0.3;
constexpr double kErrorPerMetre = 0.1;
constexpr double kLeastErrorRad = 0.15;
constexpr double kRadiansPerMetre = 0.03;

double step_m(const KeyFrame& a, const KeyFrame& b) {
  return (a.centre_in_world() - b.centre_in_world()).norm() +
         kMetresPerRadian * rotation_angle(a.cam_from_world.rotation * b.cam_from_world.rotation.transpose());
}

std::vector<KeyFrameId> joined_to(const KeyFrame& keyframe) {
  std::vector<KeyFrameId> joined = keyframe.children;
  joined.insert(joined.end(), keyframe.loops.begin(), keyframe.loops.end());
  if (keyframe.parent.valid()) joined.push_back(keyframe.parent);
  for (const Covisible& edge : keyframe.covisible) joined.push_back(edge.keyframe);
  return joined;
}

}  // namespace

std::optional<double> chain_length_m(const Map& map, KeyFrameId from, KeyFrameId to) {
  // Dijkstra 1959.
  using Reached = std::pair<double, KeyFrameId>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  std::set<KeyFrameId> done;
  front.emplace(0.0, from);
  while (!front.empty()) {
    const auto [length_m, id] = front.top();
    front.pop();
    if (id == to) return length_m;
    if (!done.insert(id).second) continue;
    const KeyFrame& keyframe = *map.keyframe(id);
    for (const KeyFrameId other : joined_to(keyframe)) {
      if (!done.contains(other)) front.emplace(length_m + step_m(keyframe, *map.keyframe(other)), other);
    }
  }
  return std::nullopt;
}

bool is_plausible(const Map& map, const LoopEdge& loop) {
  const std::optional<double> length_m = chain_length_m(map, loop.matched, loop.current);
  if (!length_m) return true;
  const SE3 expected =
      map.keyframe(loop.current)->cam_from_world * map.keyframe(loop.matched)->cam_from_world.inverse();
  const SE3 error = loop.current_from_matched * expected.inverse();
  return error.translation.norm() < kLeastErrorM + kErrorPerMetre * *length_m &&
         rotation_angle(error.rotation) < kLeastErrorRad + kRadiansPerMetre * *length_m;
}

}  // namespace cpslam
