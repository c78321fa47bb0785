#include "optim/reprojection_cost.h"

#include <gtest/gtest.h>

#include "optim/reprojection.h"
#include "optim/scenes.h"

namespace cpslam {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Residuals after the pose moves by exp(twist) and the point by the offset, through the manifold as Ceres
/// does it.
template <int kRows>
Eigen::Matrix<double, kRows, 1> residuals_at(const ReprojectionCost<kRows>& cost, const double* pose,
                                             const Eigen::Vector3d& point, const Vector6d& twist) {
  std::array<double, 7> moved{};
  EXPECT_TRUE(PoseManifold().Plus(pose, twist.data(), moved.data()));
  const std::array<const double*, 2> parameters{moved.data(), point.data()};
  Eigen::Matrix<double, kRows, 1> residuals;
  EXPECT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), nullptr));
  return residuals;
}

/// Central differences against the analytic Jacobians at one state. The point lies at point_in_cam.
template <int kRows>
void expect_jacobians_match(const Eigen::Vector3d& point_in_cam, Random& random) {
  const SE3 cam_from_world = SE3::exp(scenes::random_twist(2.0, random.uniform(0.0, 3.1), random));
  const Eigen::Vector3d point = cam_from_world.inverse() * point_in_cam;
  const ReprojectionCamera camera = scenes::camera();
  PointObservation seen = scenes::observe(scenes::visible_point(random), false, 1.0, random);
  if (kRows == 3) seen.disparity = random.uniform(1.0, 100.0);
  const ReprojectionCost<kRows> cost(camera, seen);

  std::array<double, 7> pose{};
  write_pose_block(cam_from_world, pose.data());
  const std::array<const double*, 2> parameters{pose.data(), point.data()};
  Eigen::Matrix<double, kRows, 1> residuals;
  Eigen::Matrix<double, kRows, 7, Eigen::RowMajor> by_pose;
  Eigen::Matrix<double, kRows, 3, Eigen::RowMajor> by_point;
  std::array<double*, 2> jacobians{by_pose.data(), by_point.data()};
  ASSERT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), jacobians.data()));
  EXPECT_TRUE(residuals.isApprox(residuals_at(cost, pose.data(), point, Vector6d::Zero()), 1e-12));
  EXPECT_TRUE(by_pose.col(6).isZero(0.0)) << "the lifted column must stay empty";

  const double h = 1e-6;
  Eigen::Matrix<double, kRows, 6> numeric_by_pose;
  for (int i = 0; i < 6; ++i) {
    const Vector6d twist = h * Vector6d::Unit(i);
    numeric_by_pose.col(i) = (residuals_at<kRows>(cost, pose.data(), point, twist) -
                              residuals_at<kRows>(cost, pose.data(), point, -twist)) /
                             (2.0 * h);
  }
  Eigen::Matrix<double, kRows, 3> numeric_by_point;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d offset = h * Eigen::Vector3d::Unit(i);
    numeric_by_point.col(i) = (residuals_at<kRows>(cost, pose.data(), point + offset, Vector6d::Zero()) -
                               residuals_at<kRows>(cost, pose.data(), point - offset, Vector6d::Zero())) /
                              (2.0 * h);
  }
  const double tolerance = 1e-6 * numeric_by_pose.cwiseAbs().maxCoeff() + 1e-5;
  EXPECT_LT((numeric_by_pose - by_pose.template leftCols<6>()).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LT((numeric_by_point - by_point).cwiseAbs().maxCoeff(), tolerance);

  // A block that Ceres holds constant asks for no Jacobian.
  std::array<double*, 2> only_point{nullptr, by_point.data()};
  EXPECT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), only_point.data()));
  std::array<double*, 2> only_pose{by_pose.data(), nullptr};
  EXPECT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), only_pose.data()));
}

TEST(ReprojectionCost, AnalyticJacobiansMatchNumericOnesInFrontOfTheCamera) {
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    expect_jacobians_match<2>(scenes::visible_point(random), random);
    expect_jacobians_match<3>(scenes::visible_point(random), random);
  }
}

TEST(ReprojectionCost, AnalyticJacobiansMatchNumericOnesBehindTheCamera) {
  Random random(12);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d behind(random.normal(), random.normal(), random.uniform(-2.0, 0.0));
    expect_jacobians_match<2>(behind, random);
    expect_jacobians_match<3>(behind, random);
  }
}

TEST(ReprojectionCost, ResidualsAreThoseOfAPinholeWorkedByHand) {
  // x / z = 0.5, y / z = -0.25, z = 2: u = 310, v = 215, disparity = 20.
  const ReprojectionCamera camera{100.0, 100.0, 260.0, 240.0, 40.0};
  PointObservation seen;
  seen.uv = {312.0, 214.0};
  seen.disparity = 23.0;
  seen.sigma_px = 2.0;
  seen.sigma_disparity_px = 0.5;
  const DepthCost cost(camera, seen);
  std::array<double, 7> pose{};
  write_pose_block(SE3(Eigen::Matrix3d::Identity(), {0.0, 0.0, 1.0}), pose.data());
  const Eigen::Vector3d point(1.0, -0.5, 1.0);
  const std::array<const double*, 2> parameters{pose.data(), point.data()};
  Eigen::Vector3d residuals;
  ASSERT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), nullptr));
  EXPECT_NEAR(residuals[0], (312.0 - 310.0) / 2.0, 1e-12);
  EXPECT_NEAR(residuals[1], (214.0 - 215.0) / 2.0, 1e-12);
  EXPECT_NEAR(residuals[2], (23.0 - 20.0) / 0.5, 1e-12);
}

TEST(InverseDepth, IsContinuousWithItsSlopeAndFallsEverywhere) {
  const auto above = inverse_depth(kMinDepthM * (1.0 + 1e-9));
  const auto below = inverse_depth(kMinDepthM * (1.0 - 1e-9));
  EXPECT_NEAR(above.value / below.value, 1.0, 1e-8);
  EXPECT_NEAR(above.minus_slope / below.minus_slope, 1.0, 1e-8);
  double last = inverse_depth(-10.0).value;
  for (double z = -9.99; z < 10.0; z += 0.0037) {
    const double value = inverse_depth(z).value;
    EXPECT_LT(value, last);
    last = value;
  }
  EXPECT_DOUBLE_EQ(inverse_depth(4.0).value, 0.25);
}

}  // namespace
}  // namespace cpslam
