#pragma once

#include <Eigen/Core>

#include "geometry/se3.h"

namespace cpslam {

/// Carries twists (translation, rotation) from the frame of the source to that of the target:
/// T exp(x) = exp(adjoint(T) x) T.
[[nodiscard]] Eigen::Matrix<double, 6, 6> adjoint(const SE3& transform);

/// J^-1 of log(exp(d) exp(x)) = x + J^-1 d + O(d^2), the inverse left Jacobian of SE(3) (Barfoot 2017, ch.
/// 7). Defined for rotation angles below 2 pi.
[[nodiscard]] Eigen::Matrix<double, 6, 6> left_jacobian_inverse(const Eigen::Matrix<double, 6, 1>& twist);

}  // namespace cpslam
