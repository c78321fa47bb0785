#pragma once

#include "cpslam/snapshot.h"
#include "map/map.h"

namespace cpslam {

/// Copies what a viewer shows of a session of the map, all but the trajectory. Takes a shared lock of the
/// map.
[[nodiscard]] MapSnapshot copy_for_viewer(const Map& map, int session = 1);

}  // namespace cpslam
