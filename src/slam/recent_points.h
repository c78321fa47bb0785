#pragma once

#include <cstdint>
#include <vector>

#include "map/map.h"

namespace cpslam {

/// Points on probation: in its first three keyframes a point must be found where it should be visible and be
/// seen again by other keyframes, or it goes (Mur-Artal et al. 2015, VI-B).
class RecentPoints {
 public:
  void add(const std::vector<MapPointId>& points) {
    points_.insert(points_.end(), points.begin(), points.end());
  }
  /// Puts the keyframe's own new points on probation and judges all that are. Takes a unique lock of the map.
  void cull(Map& map, KeyFrameId current);

 private:
  std::vector<MapPointId> points_;
};

}  // namespace cpslam
