#pragma once

#include "map/map.h"
#include "slam/frame.h"
#include "slam/rig.h"

namespace cpslam {

/// Puts a tracked frame into the map: the keyframe, its observations of the points it was matched to, and new
/// points for its close keypoints (at least the 300 nearest with depth). The frame's matches then refer to
/// those points too. Takes a unique lock of the map.
KeyFrameId insert_keyframe(const Rig& rig, Map& map, Frame& frame);

}  // namespace cpslam
