#pragma once

#include <Eigen/Core>
#include <span>

#include "geometry/se3.h"

namespace cpslam {

/// The rigid transform target_from_source that minimises sum |target_i - T source_i|^2 (Horn 1987, by the SVD
/// of Arun et al. 1987 with Umeyama's sign correction). No scale. Throws InputError when the sets differ in
/// size or have fewer than three members; collinear sets give one of the equally good answers.
[[nodiscard]] SE3 align_points(std::span<const Eigen::Vector3d> source,
                               std::span<const Eigen::Vector3d> target);

}  // namespace cpslam
