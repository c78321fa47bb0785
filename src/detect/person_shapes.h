#pragma once

#include <vector>

#include "cpslam/snapshot.h"
#include "detect/grid_camera.h"
#include "detect/person_track.h"
#include "geometry/se3.h"

namespace cpslam {

/// The people's surfaces in the world, a point per cell of the depth grid, for a viewer. Thread-safe.
[[nodiscard]] std::vector<PersonShape> person_shapes(const GridCamera& camera,
                                                     const std::vector<PersonTrack>& tracks,
                                                     const SE3& world_from_camera);

}  // namespace cpslam
