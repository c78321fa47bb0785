#include "geometry/se3.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "util/random.h"

namespace cpslam {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
constexpr double kPi = std::numbers::pi;

Eigen::Vector3d random_direction(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

/// Angles in every region where the formulas change: zero, tiny, around the switch to the series, near pi.
std::vector<double> angles() {
  std::vector<double> all = {0.0,     1e-300,    1e-20, 1e-12, 1e-8,       1e-6,       5e-5,
                             9.99e-5, 1.0001e-4, 2e-4,  1e-3,  0.01,       0.1,        0.5,
                             1.0,     2.0,       3.0,   3.14,  kPi - 1e-3, kPi - 1e-6, kPi - 1e-9};
  Random random(17);
  for (int i = 0; i < 200; ++i) all.push_back(random.uniform(0.0, kPi));
  return all;
}

/// exp of the 4x4 matrix of a twist by its power series, halved ten times and squared back.
Eigen::Matrix4d matrix_exponential(const Vector6d& twist) {
  Eigen::Matrix4d generator = Eigen::Matrix4d::Zero();
  generator.topLeftCorner<3, 3>() = skew(twist.tail<3>());
  generator.topRightCorner<3, 1>() = twist.head<3>();
  generator /= 1024.0;
  Eigen::Matrix4d term = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d sum = term;
  for (int k = 1; k < 20; ++k) {
    term = term * generator / k;
    sum += term;
  }
  for (int i = 0; i < 10; ++i) sum = sum * sum;
  return sum;
}

SE3 random_transform(Random& random) {
  return {so3_exp(random_direction(random) * random.uniform(0.0, kPi)),
          random_direction(random) * random.uniform(0, 9)};
}

double difference(const SE3& a, const SE3& b) {
  return std::max((a.rotation - b.rotation).cwiseAbs().maxCoeff(),
                  (a.translation - b.translation).cwiseAbs().maxCoeff());
}

TEST(So3, SkewIsTheCrossProduct) {
  const Eigen::Vector3d a(1.0, -2.0, 3.0);
  const Eigen::Vector3d b(0.5, 4.0, -1.0);
  EXPECT_TRUE(skew(a).isApprox(-skew(a).transpose(), 0.0));
  EXPECT_TRUE((skew(a) * b).isApprox(a.cross(b), 1e-15));
}

TEST(So3, ExpIsTheRotationAboutTheAxis) {
  Random random(1);
  for (const double angle : angles()) {
    const Eigen::Vector3d axis = random_direction(random);
    const Eigen::Matrix3d rotation = so3_exp(axis * angle);
    EXPECT_LT((rotation - Eigen::AngleAxisd(angle, axis).toRotationMatrix()).cwiseAbs().maxCoeff(), 1e-14)
        << angle;
    EXPECT_LT((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_NEAR(rotation.determinant(), 1.0, 1e-14);
  }
}

TEST(So3, LogInvertsExpToDoublePrecision) {
  Random random(2);
  for (const double angle : angles()) {
    const Eigen::Vector3d vector = random_direction(random) * angle;
    EXPECT_LT((so3_log(so3_exp(vector)) - vector).norm(), 1e-14 + 1e-14 * angle) << angle;
    EXPECT_NEAR(rotation_angle(so3_exp(vector)), angle, 1e-14);
  }
}

TEST(So3, LogOfHalfATurnGivesOneOfTheTwoAxes) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d axis = i < 3 ? Eigen::Vector3d(Eigen::Vector3d::Unit(i)) : random_direction(random);
    const Eigen::Matrix3d rotation = 2.0 * axis * axis.transpose() - Eigen::Matrix3d::Identity();
    const Eigen::Vector3d vector = so3_log(rotation);
    EXPECT_NEAR(vector.norm(), kPi, 1e-14);
    EXPECT_NEAR(std::abs(vector.normalized().dot(axis)), 1.0, 1e-14);
  }
}

TEST(So3, AngleStaysInZeroToPi) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const double angle = random.uniform(kPi, 2.0 * kPi);
    EXPECT_NEAR(rotation_angle(so3_exp(random_direction(random) * angle)), 2.0 * kPi - angle, 1e-13);
  }
}

TEST(Se3, ExpIsTheMatrixExponential) {
  Random random(5);
  for (const double angle : angles()) {
    Vector6d twist;
    twist << random_direction(random) * random.uniform(0.0, 5.0), random_direction(random) * angle;
    const SE3 transform = SE3::exp(twist);
    const Eigen::Matrix4d expected = matrix_exponential(twist);
    EXPECT_LT((transform.rotation - expected.topLeftCorner<3, 3>()).cwiseAbs().maxCoeff(), 1e-12) << angle;
    EXPECT_LT((transform.translation - expected.topRightCorner<3, 1>()).cwiseAbs().maxCoeff(), 1e-11)
        << angle;
  }
}

TEST(Se3, LeftJacobianKeepsItsDigitsAtSmallAngles) {
  // About z with v along x the translation is v (sin a / a, (1 - cos a) / a, 0).
  for (const double angle : {9e-5, 1.1e-4, 3e-4, 1e-3, 1e-2}) {
    Vector6d twist = Vector6d::Zero();
    twist[0] = 1.0;
    twist[5] = angle;
    const double a2 = angle * angle;
    const double expected_y = angle * (0.5 - a2 / 24.0 * (1.0 - a2 / 30.0));
    EXPECT_NEAR(SE3::exp(twist).translation.y(), expected_y, 1e-15 + 1e-13 * expected_y) << angle;
  }
}

TEST(Se3, LogInvertsExp) {
  Random random(6);
  for (const double angle : angles()) {
    Vector6d twist;
    twist << random_direction(random) * random.uniform(0.0, 5.0), random_direction(random) * angle;
    EXPECT_LT((SE3::exp(twist).log() - twist).norm(), 1e-12) << angle;
    const SE3 transform = random_transform(random);
    EXPECT_LT(difference(SE3::exp(transform.log()), transform), 1e-12);
  }
}

TEST(Se3, GroupLaws) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const SE3 a = random_transform(random);
    const SE3 b = random_transform(random);
    const SE3 c = random_transform(random);
    const Eigen::Vector3d p = random_direction(random) * 3.0;
    EXPECT_LT(difference(a * a.inverse(), SE3()), 1e-13);
    EXPECT_LT(difference(a.inverse() * a, SE3()), 1e-13);
    EXPECT_LT(difference((a * b) * c, a * (b * c)), 1e-13);
    EXPECT_LT(((a * b) * p - a * (b * p)).norm(), 1e-13);
    EXPECT_LT((a.inverse() * (a * p) - p).norm(), 1e-13);
    EXPECT_LT(difference((a * b).inverse(), b.inverse() * a.inverse()), 1e-13);
  }
}

TEST(Se3, NormalizedStopsTheDriftOfLongChains) {
  Random random(8);
  const SE3 step = random_transform(random);
  SE3 chain;
  for (int i = 0; i < 100000; ++i) chain = SE3(chain.rotation * step.rotation, chain.translation);
  const auto error = [](const SE3& t) {
    return (t.rotation * t.rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  };
  EXPECT_GT(error(chain), 1e-13) << "the chain is long enough to matter";
  EXPECT_LT(error(chain.normalized()), 1e-15 * 4.0);
  EXPECT_LT(difference(chain.normalized(), chain), 1e-9);
}

TEST(Se3, PoseKeepsTheTransform) {
  Random random(9);
  for (int i = 0; i < 100; ++i) {
    const SE3 transform = random_transform(random);
    const Pose pose = to_pose(transform);
    double length = 0.0;
    for (const double q : pose.rotation_xyzw) length += q * q;
    EXPECT_NEAR(length, 1.0, 1e-14);
    EXPECT_LT(difference(from_pose(pose), transform), 1e-14);
  }
  // A quarter turn about z, by hand; the length of the quaternion does not matter.
  const SE3 quarter = from_pose({{0.0, 0.0, 2.0, 2.0}, {1.0, 2.0, 3.0}});
  EXPECT_TRUE((quarter * Eigen::Vector3d(1.0, 0.0, 0.0)).isApprox(Eigen::Vector3d(1.0, 3.0, 3.0), 1e-15));
}

}  // namespace
}  // namespace cpslam
