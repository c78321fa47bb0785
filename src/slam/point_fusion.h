#pragma once

#include <vector>

#include "map/map.h"
#include "slam/rig.h"

namespace cpslam {

/// Finds the keyframe's points in its neighbours (and their neighbours), and theirs in it: a keypoint without
/// a point gains the observation, two points for one keypoint become one. Afterwards the keyframe's
/// covisibility is recounted. Takes shared locks to copy and unique ones to write.
void fuse_points(const Rig& rig, Map& map, KeyFrameId keyframe);

/// Finds the points of the sources in each of the targets, likewise. Covisibility is left as it is.
void fuse_between(const Rig& rig, Map& map, const std::vector<KeyFrameId>& sources,
                  const std::vector<KeyFrameId>& targets);

}  // namespace cpslam
