#include "optim/pose_manifold.h"

namespace cpslam {
namespace {

using RowMajor76 = Eigen::Matrix<double, 7, 6, Eigen::RowMajor>;
using RowMajor67 = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;
using Twist = Eigen::Matrix<double, 6, 1>;

}  // namespace

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const SE3 step = SE3::exp(Eigen::Map<const Twist>(delta));
  const Eigen::Map<const Eigen::Quaterniond> rotation(x);
  const Eigen::Map<const Eigen::Vector3d> translation(x + 4);
  const Eigen::Quaterniond moved = (step.quaternion() * rotation).normalized();
  Eigen::Map<Eigen::Vector4d> moved_rotation(x_plus_delta);
  Eigen::Map<Eigen::Vector3d> moved_translation(x_plus_delta + 4);
  moved_rotation = moved.coeffs();
  moved_translation = step * translation;
  return true;
}

bool PoseManifold::PlusJacobian(const double* /*x*/, double* jacobian) const {
  Eigen::Map<RowMajor76> by_delta(jacobian);
  by_delta.setIdentity();
  return true;
}

bool PoseManifold::RightMultiplyByPlusJacobian(const double* /*x*/, int num_rows,
                                               const double* ambient_matrix, double* tangent_matrix) const {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajor>(tangent_matrix, num_rows, kTangent) =
      Eigen::Map<const RowMajor>(ambient_matrix, num_rows, kAmbient).leftCols<kTangent>();
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<Twist>(y_minus_x, kTangent) = (read_pose_block(y) * read_pose_block(x).inverse()).log();
  return true;
}

bool PoseManifold::MinusJacobian(const double* /*x*/, double* jacobian) const {
  Eigen::Map<RowMajor67> by_y(jacobian);
  by_y.setIdentity();
  return true;
}

void write_pose_block(const SE3& pose, double* block) {
  Eigen::Map<Eigen::Vector4d> rotation(block);
  Eigen::Map<Eigen::Vector3d> translation(block + 4);
  rotation = pose.quaternion().coeffs();
  translation = pose.translation;
}

SE3 read_pose_block(const double* block) {
  const Eigen::Map<const Eigen::Quaterniond> rotation(block);
  const Eigen::Map<const Eigen::Vector3d> translation(block + 4);
  return {Eigen::Quaterniond(rotation), translation};
}

}  // namespace cpslam
