#include "geometry/se3_jacobian.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace cpslam {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// Below this angle the closed forms lose digits, and six terms of the series are exact to double precision.
constexpr double kSmallAngle = 0.03;

Matrix6d twist_commutator(const Eigen::Matrix<double, 6, 1>& twist) {
  Matrix6d ad = Matrix6d::Zero();
  ad.topLeftCorner<3, 3>() = skew(twist.tail<3>());
  ad.topRightCorner<3, 3>() = skew(twist.head<3>());
  ad.bottomRightCorner<3, 3>() = skew(twist.tail<3>());
  return ad;
}

/// The left Jacobian is the series sum ad^n / (n + 1)!. With ad's eigenvalues 0 and twice +-i angle, it is
/// the polynomial of fourth degree that agrees with (e^x - 1) / x there, at +-i angle with its derivative
/// too.
std::array<double, 4> polynomial(double angle) {
  const double s = std::sin(angle);
  const double c = std::cos(angle);
  const double angle2 = angle * angle;
  return {(4.0 - 4.0 * c - angle * s) / (2.0 * angle2),
          (4.0 * angle - 5.0 * s + angle * c) / (2.0 * angle2 * angle),
          (2.0 - 2.0 * c - angle * s) / (2.0 * angle2 * angle2),
          (2.0 * angle - 3.0 * s + angle * c) / (2.0 * angle2 * angle2 * angle)};
}

/// Horner's scheme of I + f[0] ad + f[1] ad^2 + ...
template <std::size_t kTerms>
Matrix6d evaluate(const std::array<double, kTerms>& factors, const Matrix6d& ad) {
  Matrix6d sum = Matrix6d::Zero();
  for (std::size_t i = kTerms; i > 0; --i) {
    sum.diagonal().array() += factors[i - 1];
    sum = (sum * ad).eval();
  }
  sum.diagonal().array() += 1.0;
  return sum;
}

}  // namespace

Matrix6d adjoint(const SE3& transform) {
  Matrix6d result = Matrix6d::Zero();
  result.topLeftCorner<3, 3>() = transform.rotation;
  result.topRightCorner<3, 3>() = skew(transform.translation) * transform.rotation;
  result.bottomRightCorner<3, 3>() = transform.rotation;
  return result;
}

Matrix6d left_jacobian_inverse(const Eigen::Matrix<double, 6, 1>& twist) {
  constexpr std::array<double, 6> kSeries{1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720, 1.0 / 5040};
  const double angle = twist.tail<3>().norm();
  const Matrix6d ad = twist_commutator(twist);
  return (angle < kSmallAngle ? evaluate(kSeries, ad) : evaluate(polynomial(angle), ad)).inverse();
}

}  // namespace cpslam
