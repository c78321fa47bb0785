#pragma once

#include <Eigen/Geometry>

#include "ceres/manifold.h"
#include "geometry/se3.h"

namespace cpslam {

/// Rigid transforms as Ceres sees them: seven doubles, unit quaternion (x, y, z, w) and translation (m), with
/// the left perturbation Plus(x, delta) = exp(delta) * x, delta = (translation, rotation).
///
/// The Jacobians are "lifted": cost functions put their derivative by delta into the first six of the seven
/// columns and zeros into the last, and PlusJacobian says [I6; 0], so that Ceres's product of the two is that
/// derivative. No cost function of an unlifted kind may be mixed in.
class PoseManifold final : public ceres::Manifold {
 public:
  static constexpr int kAmbient = 7;
  static constexpr int kTangent = 6;

  int AmbientSize() const override { return kAmbient; }
  int TangentSize() const override { return kTangent; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool RightMultiplyByPlusJacobian(const double* x, int num_rows, const double* ambient_matrix,
                                   double* tangent_matrix) const override;
  /// log(y * x^-1).
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

/// The seven doubles of a pose block and back.
void write_pose_block(const SE3& pose, double* block);
[[nodiscard]] SE3 read_pose_block(const double* block);

}  // namespace cpslam
