#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "map/map.h"
#include "slam/frame.h"
#include "slam/local_map.h"
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
};

/// What is known about a frame before it is looked at.
struct PlacementPrior {
  const Frame& last;  ///< the latest frame with a pose
  int last_inliers = 0;
  SE3 predicted_cam_from_world;
  std::size_t frames_without_pose = 0;
};

/// Finds the pose of a frame: by the motion so far, or, when that fails or convinces little, by the
/// appearance of known keyframes. Owns the local map. One thread; takes shared locks of the map.
class FramePlacer {
 public:
  FramePlacer(const Rig& rig, const Map& map, StageTimer& timer)
      : rig_(rig), map_(map), timer_(timer), random_(rig.settings.seed) {}

  /// On success the frame has a pose and its matches; nothing when fewer than Tracking.minInliers points
  /// agree.
  [[nodiscard]] std::optional<Placement> place(const PlacementPrior& prior, Frame& frame);

  /// Moves the local map to a new keyframe: the placement of the frame it was made of.
  [[nodiscard]] Placement place_keyframe(KeyFrameId keyframe, int inliers);

 private:
  std::optional<Placement> by_motion(const PlacementPrior& prior, Frame& frame);
  std::optional<Placement> by_appearance(const PlacementPrior& prior, Frame& frame);
  std::optional<Placement> in_local_map(float window, Frame& frame);

  const Rig& rig_;
  const Map& map_;
  StageTimer& timer_;
  Random random_;
  LocalMap local_map_;
};

}  // namespace cpslam
