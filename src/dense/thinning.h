#pragma once

#include <vector>

#include "dense/voxel_grid.h"

namespace cpslam {

/// Makes one layer of the several that a noisy surface fills: along the axis nearest to its normal only the
/// voxel with the most weight stays, moved to the mean of those it stands for. Keeps the order.
[[nodiscard]] std::vector<Voxel> thin(const std::vector<Voxel>& voxels);

}  // namespace cpslam
