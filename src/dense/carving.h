#pragma once

#include <vector>

#include "dense/dense_views.h"
#include "dense/voxel_grid.h"

namespace cpslam {

/// Keeps the voxels that the views agree on: one is free space when views look through it, at something
/// behind, half as often as they find a surface there. So goes who passed by unnoticed, and the place a chair
/// was moved from. Thin things stay: a view looks through only where all its blocks around do.
/// voxels: as VoxelGrid has them ordered. Thread-safe.
[[nodiscard]] std::vector<Voxel> carve(std::vector<Voxel> voxels, float side_m, const DenseCamera& camera,
                                       const std::vector<PlacedView>& views);

}  // namespace cpslam
