#pragma once

#include <vector>

#include "map/map.h"
#include "slam/rig.h"

namespace cpslam {

/// Frees the covisible neighbours of a keyframe that add nothing: 90 % of their close points are seen by at
/// least three other keyframes at the same or a finer scale (Mur-Artal et al. 2015, VI-E). Takes a unique
/// lock of the map for each keyframe in turn. Returns those that are gone.
std::vector<KeyFrameId> cull_keyframes(const Rig& rig, Map& map, KeyFrameId around);

}  // namespace cpslam
