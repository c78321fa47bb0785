#pragma once

#include <Eigen/Core>
#include <optional>

#include "cpslam/snapshot.h"

namespace cpslam::viewer {

/// A ball around what is worth seeing, and where its floor seems to be.
struct Extent {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
  double floor_m = 0.0;  ///< height along up, of nearly the lowest points
};

/// Around the trajectory and all but the outermost points of the map; nothing while there is neither.
[[nodiscard]] std::optional<Extent> extent_of(const MapSnapshot& map, const Eigen::Vector3d& up);

/// Up, as nearly as one can tell without a sense of gravity: the mean up of the keyframes' cameras, which
/// people and robots hold level more often than not. Unit length; that of the first camera without keyframes.
[[nodiscard]] Eigen::Vector3d up_of(const MapSnapshot& map);

}  // namespace cpslam::viewer
