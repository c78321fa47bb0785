#pragma once

#include <optional>
#include <vector>

#include "map/map.h"
#include "slam/frame.h"
#include "slam/local_map.h"
#include "slam/places.h"
#include "slam/rig.h"
#include "util/random.h"
#include "util/stage_timer.h"

namespace cpslam {

/// A frame's place in the map.
struct Placement {
  int inliers = 0;                   ///< map points that agree with the pose
  std::vector<MapPointId> expected;  ///< map points that should be visible
  KeyFrameId reference;              ///< the keyframe that shares most points with the frame
  SE3 reference_from_world;  ///< its pose at the time the points were read: what the frame's pose agrees with
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< PoseSolverResult's
  bool bridged = false;  ///< the inliers are what the frames before saw, hardly any of them in the map
};

/// What is known about a frame before it is looked at.
struct PlacementPrior {
  const Frame& last;  ///< the latest frame with a pose
  int last_inliers = 0;
  SE3 predicted_cam_from_world;
  bool was_lost = false;    ///< the frame before got no pose: where the camera is since is a guess
  bool may_bridge = false;  ///< where the map has little or nothing, go by what the last frame saw
};

/// Finds the pose of a frame: by the motion so far, or, when that fails or convinces little, by the
/// appearance of known keyframes; for those who add nothing to the map also by what the last frame saw, where
/// the map has little or nothing. Owns the local map. One thread; takes shared locks of the map.
class FramePlacer {
 public:
  /// places: null when places are not recognised.
  FramePlacer(const Rig& rig, const Map& map, const Places* places, StageTimer& timer)
      : rig_(rig), map_(map), places_(places), timer_(timer), random_(rig.settings.seed) {}

  /// On success the frame has a pose and its matches; nothing when fewer than Tracking.minInliers points
  /// agree.
  [[nodiscard]] std::optional<Placement> place(const PlacementPrior& prior, Frame& frame);

  /// Moves the local map to a new keyframe: the placement of the frame it was made of, which was this one.
  [[nodiscard]] Placement place_keyframe(KeyFrameId keyframe, const Placement& placement);

 private:
  std::optional<Placement> by_motion(const PlacementPrior& prior, Frame& frame);
  /// Whether the map has so little here that the last frame may have more.
  [[nodiscard]] bool is_few(const std::optional<Placement>& moved) const;
  /// On what the last frame saw, in the map or not, if that is clearly more; else leaves it at `moved`.
  std::optional<Placement> by_last_frame(const PlacementPrior& prior, std::optional<Placement> moved,
                                         Frame& frame);
  /// A frame placed where it looks like, and the map around.
  struct Recognised {
    Frame frame;
    Placement placement;
    LocalMap local_map;
  };
  std::optional<Recognised> by_appearance(const Frame& frame);
  std::optional<Recognised> by_keyframe(KeyFrameId keyframe, const ImageWords& words, const Frame& frame);
  std::optional<Placement> in_local_map(float window, LocalMap& local_map, Frame& frame);

  const Rig& rig_;
  const Map& map_;
  const Places* places_;
  StageTimer& timer_;
  Random random_;
  LocalMap local_map_;
};

}  // namespace cpslam
