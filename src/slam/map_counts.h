#pragma once

#include <vector>

#include "cpslam/types.h"
#include "map/map.h"

namespace cpslam {

/// What each session of the map has, the one with most of these frames first; of like ones, the older. Takes
/// a shared lock of the map.
[[nodiscard]] std::vector<MapCounts> count_maps(const Map& map, const Trajectory& frames);

}  // namespace cpslam
