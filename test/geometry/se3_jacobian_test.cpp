#include "geometry/se3_jacobian.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "util/random.h"

namespace cpslam {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

Vector6d random_twist(double angle, Random& random) {
  Vector6d twist;
  for (int i = 0; i < 6; ++i) twist[i] = random.normal();
  twist.tail<3>() *= angle / twist.tail<3>().norm();
  return twist;
}

TEST(Adjoint, CarriesATwistThroughATransform) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const SE3 transform = SE3::exp(random_twist(random.uniform(0.0, 3.0), random));
    const Vector6d twist = random_twist(random.uniform(0.0, 3.0), random);
    const SE3 before = transform * SE3::exp(twist);
    const SE3 after = SE3::exp(adjoint(transform) * twist) * transform;
    EXPECT_TRUE(before.rotation.isApprox(after.rotation, 1e-12));
    EXPECT_TRUE(before.translation.isApprox(after.translation, 1e-11));
  }
}

TEST(LeftJacobianInverse, IsTheIdentityForNoMotion) {
  EXPECT_EQ(left_jacobian_inverse(Vector6d::Zero()), Matrix6d::Identity());
}

TEST(LeftJacobianInverse, IsTheDerivativeOfTheLogarithm) {
  Random random(2);
  std::vector<double> angles{0.0, 1e-9, 1e-4, 0.0299, 0.0301, 0.1, 1.0, 2.0, 3.0};
  for (int i = 0; i < 50; ++i) angles.push_back(random.uniform(0.0, 3.0));
  constexpr double kStep = 1e-6;
  for (const double angle : angles) {
    const Vector6d twist = random_twist(angle == 0.0 ? 1.0 : angle, random);
    const Vector6d x =
        angle == 0.0 ? Vector6d(twist.cwiseProduct((Vector6d() << 1, 1, 1, 0, 0, 0).finished())) : twist;
    Matrix6d numeric;
    for (int i = 0; i < 6; ++i) {
      const Vector6d d = kStep * Vector6d::Unit(i);
      numeric.col(i) =
          ((SE3::exp(d) * SE3::exp(x)).log() - (SE3::exp(-d) * SE3::exp(x)).log()) / (2.0 * kStep);
    }
    EXPECT_LT((numeric - left_jacobian_inverse(x)).cwiseAbs().maxCoeff(), 2e-8) << angle;
  }
}

TEST(LeftJacobianInverse, SeriesAndClosedFormMeet) {
  Random random(3);
  const Vector6d direction = random_twist(1.0, random);
  const auto at = [&](double angle) {
    Vector6d twist = direction;
    twist.tail<3>() *= angle;
    return left_jacobian_inverse(twist);
  };
  // The slope there is of order one, so a millionth of a step must not show more than that.
  EXPECT_LT((at(0.03 - 1e-9) - at(0.03 + 1e-9)).cwiseAbs().maxCoeff(), 1e-8);
}

}  // namespace
}  // namespace cpslam
