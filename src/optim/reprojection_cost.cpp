#include "optim/reprojection_cost.h"

#include "optim/reprojection.h"

namespace cpslam {

template <int kRows>
bool ReprojectionCost<kRows>::Evaluate(double const* const* parameters, double* residuals,
                                       double** jacobians) const {
  const Eigen::Map<const Eigen::Quaterniond> quaternion(parameters[0]);
  const Eigen::Map<const Eigen::Vector3d> translation(parameters[0] + 4);
  const Eigen::Map<const Eigen::Vector3d> point_in_world(parameters[1]);
  const Eigen::Matrix3d rotation = quaternion.toRotationMatrix();
  const Eigen::Vector3d p = rotation * point_in_world + translation;

  Eigen::Map<Eigen::Matrix<double, kRows, 1>>(residuals, kRows) =
      reprojection_error(camera_, p, seen_).template head<kRows>();
  if (jacobians == nullptr) return true;

  const Eigen::Matrix<double, kRows, 3> by_point_in_cam =
      reprojection_jacobian(camera_, p, seen_).template topRows<kRows>();
  if (jacobians[0] != nullptr) {
    // exp(delta) p = p + v + w x p, so a row a has the derivative a by v and p x a by w.
    Eigen::Map<Eigen::Matrix<double, kRows, PoseManifold::kAmbient, Eigen::RowMajor>> by_pose(jacobians[0]);
    for (int row = 0; row < kRows; ++row) {
      const Eigen::Vector3d a = by_point_in_cam.row(row);
      by_pose.template block<1, 3>(row, 0) = a;
      by_pose.template block<1, 3>(row, 3) = p.cross(a);
      by_pose(row, 6) = 0.0;
    }
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, kRows, 3, Eigen::RowMajor>> by_point_in_world(jacobians[1]);
    by_point_in_world.noalias() = by_point_in_cam * rotation;
  }
  return true;
}

template class ReprojectionCost<2>;
template class ReprojectionCost<3>;

}  // namespace cpslam
