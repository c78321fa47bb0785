#pragma once

#include <atomic>
#include <vector>

#include "map/map.h"
#include "slam/places.h"
#include "slam/recent_points.h"
#include "slam/rig.h"
#include "util/stage_timer.h"

namespace cpslam {

/// Works a new keyframe into the map: checks recent points, makes new ones, fuses duplicates, adjusts the
/// neighbourhood and frees keyframes that add nothing (Mur-Artal et al. 2015, section VI). One thread; holds
/// the map's lock only to copy and to write back.
class LocalMapping {
 public:
  /// places: remembers new keyframes and forgets those that are freed; null when places are not recognised.
  LocalMapping(const Rig& rig, Map& map, Places* places, StageTimer& timer)
      : rig_(rig), map_(map), places_(places), timer_(timer) {}

  /// abort, read between and inside the longer steps, ends the work early with a consistent map.
  void process(KeyFrameId keyframe, const std::atomic<bool>& abort);

  [[nodiscard]] std::size_t bundle_adjustments() const { return bundle_adjustments_; }

 private:
  const Rig& rig_;
  Map& map_;
  Places* places_;
  StageTimer& timer_;
  RecentPoints recent_points_;
  std::atomic<std::size_t> bundle_adjustments_ = 0;
};

}  // namespace cpslam
