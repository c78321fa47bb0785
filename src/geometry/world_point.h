#pragma once

#include <Eigen/Core>

#include "cpslam/types.h"

namespace cpslam {

template <typename Scalar>
[[nodiscard]] WorldPoint to_world_point(const Eigen::Matrix<Scalar, 3, 1>& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

}  // namespace cpslam
