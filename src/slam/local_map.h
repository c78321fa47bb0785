#pragma once

#include <cstdint>
#include <vector>

#include "map/map.h"
#include "slam/frame.h"
#include "slam/point_snapshot.h"
#include "slam/rig.h"

namespace cpslam {

/// Tracking's own copy of the part of the map around the camera, so that matching needs no lock. Not
/// thread-safe.
class LocalMap {
 public:
  /// Gathers the keyframes that see the frame's map points, their neighbours, and the points of all of them.
  /// Copies only when the reference keyframe or the map changed. Without any match the old copy stays. Takes
  /// a shared lock.
  void update(const Map& map, const Frame& frame);
  /// The same around a given keyframe.
  void centre_on(const Map& map, KeyFrameId keyframe);

  [[nodiscard]] const std::vector<PointSnapshot>& points() const { return points_; }
  /// The keyframe that shares most points with the last frame given to update().
  [[nodiscard]] KeyFrameId reference() const { return reference_; }
  /// Its pose when the copy was made: what the copied points agree with, whatever the mapper did since.
  [[nodiscard]] const SE3& reference_from_world() const { return reference_from_world_; }

 private:
  void copy(const Map& map, const std::vector<KeyFrameId>& seeds);

  std::vector<PointSnapshot> points_;
  KeyFrameId reference_;
  SE3 reference_from_world_;
  std::uint64_t map_version_ = 0;
  std::vector<std::uint8_t> gathered_;  // by slot of the point
};

struct LocalMapMatch {
  int inliers = 0;                   ///< map points that agree with the optimised pose
  std::vector<MapPointId> expected;  ///< points that should be visible
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< PoseSolverResult's
};

/// Matches the local map's points into the frame around its present pose, optimises the pose on all matches
/// with map points and drops those that disagree. Temporary matches go before the optimisation. window scales
/// the search windows.
LocalMapMatch track_local_map(const Rig& rig, const LocalMap& local_map, float window, Frame& frame);

}  // namespace cpslam
