#pragma once

#include <vector>

#include "cpslam/types.h"

namespace cpslam {

/// The poses of each map apart, in their order: within one world each, so that they can be compared with a
/// ground truth. The map with most poses comes first; of like ones, the older.
[[nodiscard]] std::vector<Trajectory> split_by_map(const Trajectory& trajectory);

}  // namespace cpslam
