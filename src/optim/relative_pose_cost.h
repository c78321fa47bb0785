#pragma once

#include <Eigen/Core>

#include "ceres/sized_cost_function.h"
#include "geometry/se3.h"
#include "optim/pose_manifold.h"

namespace cpslam {

/// Whitened error of a measured relative pose: root * log(b_from_world * world_from_a * measured^-1), where
/// root^T root is the measurement's information about the twist (translation m, rotation rad) on b's side.
/// Analytic lifted Jacobians. Parameter blocks: a_from_world, b_from_world of PoseManifold.
class RelativePoseCost final
    : public ceres::SizedCostFunction<6, PoseManifold::kAmbient, PoseManifold::kAmbient> {
 public:
  RelativePoseCost(const SE3& b_from_a, const Eigen::Matrix<double, 6, 6>& root_information)
      : a_from_b_(b_from_a.inverse()), root_information_(root_information) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  SE3 a_from_b_;
  Eigen::Matrix<double, 6, 6> root_information_;
};

}  // namespace cpslam
