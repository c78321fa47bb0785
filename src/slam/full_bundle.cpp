#include "slam/full_bundle.h"

#include <shared_mutex>

#include "slam/map_correction.h"

namespace cpslam {
namespace {

// What is wrong with the depths of corners differs from view to view and averages out over a map; believed as
// little as for single poses, all depths together fix its scale to no better than 0.2 to 0.4 % against the
// bias of triangulation (docs/benchmarks.md).
constexpr double kMinDisparitySigmaInMapPx = 1.0;

BundleSnapshot copy_map(const Rig& rig, const Map& map) {
  const std::shared_lock lock(map.mutex());
  BundleSnapshotBuilder builder(rig, map, kMinDisparitySigmaInMapPx);
  for (const KeyFrameId id : map.keyframes_by_sequence()) {
    builder.add_keyframe(id, map.is_root(id));
  }
  builder.add_points();
  builder.add_observations();
  return builder.take();
}

}  // namespace

std::optional<FullBundle> adjust_full_bundle(const Rig& rig, const Map& map, const std::atomic<bool>& abort) {
  FullBundle bundle{copy_map(rig, map), {}};
  if (bundle.snapshot.keyframes.size() < 2 || bundle.snapshot.problem.observations.empty())
    return std::nullopt;
  BundleOptions options;
  options.abort = &abort;
  bundle.result = adjust_bundle(bundle.snapshot.problem, options);
  if (bundle.result.aborted) return std::nullopt;
  return bundle;
}

void write_back(Map& map, const FullBundle& bundle) {
  const BundleSnapshot& snapshot = bundle.snapshot;
  MapCorrection correction;
  for (std::size_t k = 0; k < snapshot.keyframes.size(); ++k) {
    correction.cam_from_world.emplace(snapshot.keyframes[k], snapshot.problem.cam_from_world[k]);
  }
  for (std::size_t p = 0; p < snapshot.points.size(); ++p) {
    correction.point_in_world.emplace_hint(correction.point_in_world.end(), snapshot.points[p],
                                           snapshot.problem.point_in_world[p]);
  }
  erase_outliers(map, snapshot, bundle.result);
  apply_correction(map, correction);
}

}  // namespace cpslam
