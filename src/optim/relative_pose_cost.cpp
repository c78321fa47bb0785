#include "optim/relative_pose_cost.h"

#include "geometry/se3_jacobian.h"

namespace cpslam {

bool RelativePoseCost::Evaluate(double const* const* parameters, double* residuals,
                                double** jacobians) const {
  const SE3 b_from_a = read_pose_block(parameters[1]) * read_pose_block(parameters[0]).inverse();
  const Eigen::Matrix<double, 6, 1> error = (b_from_a * a_from_b_).log();
  Eigen::Map<Eigen::Matrix<double, 6, 1>>(residuals, 6) = root_information_ * error;
  if (jacobians == nullptr) return true;

  using Jacobian = Eigen::Matrix<double, 6, PoseManifold::kAmbient, Eigen::RowMajor>;
  // exp(d) from the left of b changes the error by J^-1 d; from the left of a it comes in inverted, behind
  // b_from_a.
  const Eigen::Matrix<double, 6, 6> by_b = root_information_ * left_jacobian_inverse(error);
  if (jacobians[0] != nullptr) {
    Eigen::Map<Jacobian> by_a(jacobians[0]);
    by_a.leftCols<6>() = -by_b * adjoint(b_from_a);
    by_a.col(6).setZero();
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<Jacobian> jacobian(jacobians[1]);
    jacobian.leftCols<6>() = by_b;
    jacobian.col(6).setZero();
  }
  return true;
}

}  // namespace cpslam
