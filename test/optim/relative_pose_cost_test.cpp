#include "optim/relative_pose_cost.h"

#include <gtest/gtest.h>

#include <array>

#include "optim/scenes.h"

namespace cpslam {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Block = std::array<double, 7>;

Vector6d residuals_at(const RelativePoseCost& cost, const Block& a, const Block& b) {
  const std::array<const double*, 2> parameters{a.data(), b.data()};
  Vector6d residuals;
  EXPECT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), nullptr));
  return residuals;
}

Block moved(const Block& block, const Vector6d& twist) {
  Block result{};
  EXPECT_TRUE(PoseManifold().Plus(block.data(), twist.data(), result.data()));
  return result;
}

TEST(RelativePoseCost, IsZeroWhereTheMeasurementHolds) {
  Random random(31);
  const SE3 a = SE3::exp(scenes::random_twist(2.0, 1.0, random));
  const SE3 b = SE3::exp(scenes::random_twist(2.0, 1.0, random));
  Block block_a{};
  Block block_b{};
  write_pose_block(a, block_a.data());
  write_pose_block(b, block_b.data());
  const RelativePoseCost cost(b * a.inverse(), Matrix6d::Identity());
  EXPECT_LT(residuals_at(cost, block_a, block_b).norm(), 1e-14);
}

TEST(RelativePoseCost, AnErrorIsWeighedByTheRootOfTheInformation) {
  Block block{};
  write_pose_block(SE3(), block.data());
  const Matrix6d root = (Vector6d() << 1, 2, 3, 4, 5, 6).finished().asDiagonal();
  const Vector6d twist = 0.1 * (Vector6d() << 1, -1, 0.5, 0, 0, 2).finished();
  const RelativePoseCost cost(SE3::exp(twist).inverse(), root);
  EXPECT_TRUE(residuals_at(cost, block, block).isApprox(root * twist, 1e-12));
}

TEST(RelativePoseCost, AnalyticJacobiansMatchNumericOnes) {
  Random random(32);
  for (int trial = 0; trial < 100; ++trial) {
    const SE3 a = SE3::exp(scenes::random_twist(3.0, random.uniform(0.0, 3.0), random));
    const SE3 b = SE3::exp(scenes::random_twist(3.0, random.uniform(0.0, 3.0), random));
    // Errors from nothing to large ones; the exact zero is where optimisations end.
    const double error = trial % 10 == 0 ? 0.0 : random.uniform(0.0, 2.5);
    const SE3 measured = SE3::exp(error * scenes::random_twist(1.0, 1.0, random)) * b * a.inverse();
    Matrix6d root = Matrix6d::Random();
    root.diagonal().array() += 4.0;
    const RelativePoseCost cost(measured, root);
    Block block_a{};
    Block block_b{};
    write_pose_block(a, block_a.data());
    write_pose_block(b, block_b.data());
    const std::array<const double*, 2> parameters{block_a.data(), block_b.data()};
    Vector6d residuals;
    Eigen::Matrix<double, 6, 7, Eigen::RowMajor> by_a;
    Eigen::Matrix<double, 6, 7, Eigen::RowMajor> by_b;
    std::array<double*, 2> jacobians{by_a.data(), by_b.data()};
    ASSERT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), jacobians.data()));
    EXPECT_TRUE(by_a.col(6).isZero(0.0)) << "the lifted column must stay empty";
    EXPECT_TRUE(by_b.col(6).isZero(0.0)) << "the lifted column must stay empty";
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 6; ++i) {
      const Vector6d d = kStep * Vector6d::Unit(i);
      const Vector6d numeric_a =
          (residuals_at(cost, moved(block_a, d), block_b) - residuals_at(cost, moved(block_a, -d), block_b)) /
          (2.0 * kStep);
      const Vector6d numeric_b =
          (residuals_at(cost, block_a, moved(block_b, d)) - residuals_at(cost, block_a, moved(block_b, -d))) /
          (2.0 * kStep);
      EXPECT_LT((numeric_a - by_a.col(i)).cwiseAbs().maxCoeff(), 1e-6);
      EXPECT_LT((numeric_b - by_b.col(i)).cwiseAbs().maxCoeff(), 1e-6);
    }
    // A block that Ceres holds constant asks for no Jacobian.
    std::array<double*, 2> only_b{nullptr, by_b.data()};
    EXPECT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), only_b.data()));
    std::array<double*, 2> only_a{by_a.data(), nullptr};
    EXPECT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), only_a.data()));
  }
}

}  // namespace
}  // namespace cpslam
