#pragma once

#include <map>
#include <vector>

#include "map/map.h"
#include "optim/bundle_adjuster.h"
#include "slam/observation_model.h"
#include "slam/rig.h"

namespace cpslam {

/// Part of the map as a bundle adjustment takes it, with the ids that lead back.
struct BundleSnapshot {
  BundleProblem problem;
  std::vector<KeyFrameId> keyframes;  ///< parallel to problem.cam_from_world
  std::vector<MapPointId> points;     ///< parallel to problem.point_in_world
};

/// Copies keyframes, points and observations out of the map. The caller holds a shared lock of it as long as
/// the builder lives.
class BundleSnapshotBuilder {
 public:
  /// min_disparity_sigma_px: see observe().
  BundleSnapshotBuilder(const Rig& rig, const Map& map, double min_disparity_sigma_px = kMinDisparitySigmaPx);

  /// The keyframe must exist and not have been added before.
  void add_keyframe(KeyFrameId id, bool fixed);
  /// All points that the keyframes added so far see, by ascending id.
  void add_points();
  /// All observations of the points added from keyframes added so far.
  void add_observations();

  [[nodiscard]] bool has_keyframe(KeyFrameId id) const { return pose_index_.contains(id); }
  [[nodiscard]] const BundleSnapshot& snapshot() const { return snapshot_; }
  void fix(std::size_t keyframe) { snapshot_.problem.pose_fixed[keyframe] = 1; }
  [[nodiscard]] BundleSnapshot take() { return std::move(snapshot_); }

 private:
  const Rig& rig_;
  const Map& map_;
  double min_disparity_sigma_px_;
  BundleSnapshot snapshot_;
  std::map<KeyFrameId, int> pose_index_;
};

/// Removes the observations that the adjustment found to be outliers; what is gone already is left out. The
/// caller holds a unique lock of the map.
void erase_outliers(Map& map, const BundleSnapshot& snapshot, const BundleResult& result);

}  // namespace cpslam
