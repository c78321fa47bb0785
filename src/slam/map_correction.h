#pragma once

#include <map>

#include "map/map.h"

namespace cpslam {

/// New places for keyframes and points that were worked out on a snapshot of the map.
struct MapCorrection {
  std::map<KeyFrameId, SE3> cam_from_world;
  std::map<MapPointId, Eigen::Vector3d> point_in_world;  ///< of those that do not move with their keyframe
};

/// Writes a correction into the map as it is by now: what is gone stays gone; a keyframe that came after the
/// snapshot keeps its pose relative to its parent in the spanning tree, a point without a new place its place
/// before its reference keyframe. The caller holds a unique lock of the map.
void apply_correction(Map& map, const MapCorrection& correction);

}  // namespace cpslam
