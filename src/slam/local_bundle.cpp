#include "slam/local_bundle.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <shared_mutex>

#include "slam/bundle_snapshot.h"

namespace cpslam {
namespace {

constexpr std::size_t kMaxFreeKeyframes = 20;
constexpr std::size_t kMaxFixedKeyframes = 25;

/// The keyframes outside that see most of the points; more of them hold the gauge no better.
void add_fixed_keyframes(const Map& map, BundleSnapshotBuilder& builder) {
  std::map<KeyFrameId, int> seen_points;
  for (const MapPointId id : builder.snapshot().points) {
    for (const Observation& seen : map.point(id)->observations) {
      if (!builder.has_keyframe(seen.keyframe)) ++seen_points[seen.keyframe];
    }
  }
  std::vector<std::pair<int, KeyFrameId>> order;
  order.reserve(seen_points.size());
  for (const auto& [id, n] : seen_points) order.emplace_back(-n, id);
  std::sort(order.begin(), order.end());
  if (order.size() > kMaxFixedKeyframes) order.resize(kMaxFixedKeyframes);
  for (const auto& [n, id] : order) builder.add_keyframe(id, true);
}

/// A young map has no keyframe outside: then its oldest one stays where it is.
void hold_gauge(const Map& map, BundleSnapshotBuilder& builder) {
  const std::vector<KeyFrameId>& keyframes = builder.snapshot().keyframes;
  const auto& fixed = builder.snapshot().problem.pose_fixed;
  const auto oldest = std::min_element(
      keyframes.begin(), keyframes.end(),
      [&map](KeyFrameId a, KeyFrameId b) { return map.keyframe(a)->sequence < map.keyframe(b)->sequence; });
  if (map.is_root(*oldest) || std::find(fixed.begin(), fixed.end(), 1) == fixed.end()) {
    builder.fix(static_cast<std::size_t>(oldest - keyframes.begin()));
  }
}

/// Nothing when there is nothing to solve.
std::optional<BundleSnapshot> copy_surroundings(const Rig& rig, const Map& map, KeyFrameId centre) {
  const std::shared_lock lock(map.mutex());
  if (map.keyframe(centre) == nullptr) return std::nullopt;
  BundleSnapshotBuilder builder(rig, map);
  builder.add_keyframe(centre, false);
  for (const KeyFrameId id : map.best_covisible(centre, kMaxFreeKeyframes - 1)) {
    builder.add_keyframe(id, false);
  }
  builder.add_points();
  add_fixed_keyframes(map, builder);
  builder.add_observations();
  hold_gauge(map, builder);
  const BundleProblem& problem = builder.snapshot().problem;
  const bool free =
      std::find(problem.pose_fixed.begin(), problem.pose_fixed.end(), 0) != problem.pose_fixed.end();
  if (!free || problem.observations.empty()) return std::nullopt;
  return builder.take();
}

void write_back(Map& map, const BundleSnapshot& snapshot, const BundleResult& result) {
  erase_outliers(map, snapshot, result);
  const BundleProblem& problem = snapshot.problem;
  for (std::size_t k = 0; k < snapshot.keyframes.size(); ++k) {
    if (problem.pose_fixed[k] == 0) map.set_pose(snapshot.keyframes[k], problem.cam_from_world[k]);
  }
  for (std::size_t p = 0; p < snapshot.points.size(); ++p) {
    map.set_position(snapshot.points[p], problem.point_in_world[p]);
    map.refresh_point(snapshot.points[p]);
  }
}

}  // namespace

void adjust_local_bundle(const Rig& rig, Map& map, KeyFrameId keyframe, const std::atomic<bool>& abort) {
  std::optional<BundleSnapshot> snapshot = copy_surroundings(rig, map, keyframe);
  if (!snapshot) return;
  BundleOptions options;
  options.final_iterations = rig.settings.mapping.local_ba_iterations;
  options.abort = &abort;
  const BundleResult result = adjust_bundle(snapshot->problem, options);
  const std::unique_lock lock(map.mutex());
  write_back(map, *snapshot, result);
}

}  // namespace cpslam
