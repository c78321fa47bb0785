#include "slam/bundle_snapshot.h"

#include <algorithm>

namespace cpslam {

BundleSnapshotBuilder::BundleSnapshotBuilder(const Rig& rig, const Map& map, double min_disparity_sigma_px)
    : rig_(rig), map_(map), min_disparity_sigma_px_(min_disparity_sigma_px) {
  snapshot_.problem.camera = rig.reprojection;
}

void BundleSnapshotBuilder::add_keyframe(KeyFrameId id, bool fixed) {
  pose_index_.emplace(id, static_cast<int>(snapshot_.keyframes.size()));
  snapshot_.keyframes.push_back(id);
  snapshot_.problem.cam_from_world.push_back(map_.keyframe(id)->cam_from_world);
  snapshot_.problem.pose_fixed.push_back(fixed ? 1 : 0);
}

void BundleSnapshotBuilder::add_points() {
  std::vector<MapPointId>& points = snapshot_.points;
  for (const KeyFrameId id : snapshot_.keyframes) {
    for (const MapPointId point : map_.keyframe(id)->points) {
      if (point.valid()) points.push_back(point);
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (const MapPointId id : points) {
    snapshot_.problem.point_in_world.push_back(map_.point(id)->position_in_world);
  }
}

void BundleSnapshotBuilder::add_observations() {
  for (std::size_t p = 0; p < snapshot_.points.size(); ++p) {
    for (const Observation& seen : map_.point(snapshot_.points[p])->observations) {
      const auto pose = pose_index_.find(seen.keyframe);
      if (pose == pose_index_.end()) continue;
      snapshot_.problem.observations.push_back(
          {pose->second, static_cast<int>(p),
           observe(rig_, *map_.keyframe(seen.keyframe)->features, seen.keypoint, min_disparity_sigma_px_)});
    }
  }
}

void erase_outliers(Map& map, const BundleSnapshot& snapshot, const BundleResult& result) {
  for (std::size_t o = 0; o < snapshot.problem.observations.size(); ++o) {
    if (result.outlier[o] == 0) continue;
    const BundleProblem::Observation& seen = snapshot.problem.observations[o];
    map.erase_observation(snapshot.points[static_cast<std::size_t>(seen.point)],
                          snapshot.keyframes[static_cast<std::size_t>(seen.pose)]);
  }
}

}  // namespace cpslam
