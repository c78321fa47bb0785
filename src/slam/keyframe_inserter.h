#pragma once

#include "map/map.h"
#include "slam/frame.h"
#include "slam/frame_placer.h"
#include "slam/rig.h"

namespace cpslam {

/// Puts a tracked frame into the map: the keyframe, its observations of the points it was matched to, and new
/// points for its close keypoints (at least the 300 nearest with depth). The frame's matches then refer to
/// those points too. What the mapper did to the map since the frame was placed moves the frame along with its
/// reference keyframe first. Takes a unique lock of the map.
KeyFrameId insert_keyframe(const Rig& rig, Map& map, const Placement& placement, Frame& frame);

}  // namespace cpslam
