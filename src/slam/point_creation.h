#pragma once

#include <vector>

#include "map/map.h"
#include "slam/rig.h"

namespace cpslam {

/// Makes points from keypoints of the keyframe and its covisible neighbours that no point explains yet:
/// matched along epipolar lines, placed by triangulation where the parallax is larger than what depth gives,
/// by depth elsewhere, and kept when parallax, reprojection, depth and scale agree in both views. Takes
/// shared locks to copy and unique ones to write. Returns the new points.
std::vector<MapPointId> create_points(const Rig& rig, Map& map, KeyFrameId keyframe);

}  // namespace cpslam
