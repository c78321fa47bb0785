#pragma once

#include "slam/frame.h"
#include "slam/local_map.h"
#include "slam/rig.h"

namespace cpslam {

/// How many of the local map's points that the frame's pose lets expect were found, 0 to 1: a frame that was
/// taken for another place agrees with some of the points there, but lacks nearly all. Where the frame has no
/// keypoint near (a person stood there, the wall is bare), nothing can be found, and a point does not count.
[[nodiscard]] double found_share(const Rig& rig, const LocalMap& local_map, const Frame& frame);

}  // namespace cpslam
