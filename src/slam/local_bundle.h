#pragma once

#include <atomic>

#include "map/map.h"
#include "slam/rig.h"

namespace cpslam {

/// Bundle adjustment of a keyframe, its covisible neighbours and all points they see; the other keyframes
/// that see those points hold the gauge (Mur-Artal et al. 2015, VI-D). Works on a snapshot: the map is locked
/// only to copy and to write back. Observations beyond the 95 % gate are removed from the map.
void adjust_local_bundle(const Rig& rig, Map& map, KeyFrameId keyframe, const std::atomic<bool>& abort);

}  // namespace cpslam
