#include "optim/pose_manifold.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "optim/scenes.h"

namespace cpslam {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Block = std::array<double, 7>;

Block random_block(Random& random) {
  Block block{};
  const SE3 pose = SE3::exp(scenes::random_twist(3.0, random.uniform(0.0, std::numbers::pi), random));
  write_pose_block(pose, block.data());
  return block;
}

TEST(PoseManifold, PlusIsTheLeftPerturbation) {
  Random random(21);
  const PoseManifold manifold;
  for (int i = 0; i < 100; ++i) {
    const Block x = random_block(random);
    const Vector6d delta = scenes::random_twist(random.uniform(), random.uniform(0.0, 3.0), random);
    Block moved{};
    ASSERT_TRUE(manifold.Plus(x.data(), delta.data(), moved.data()));
    const SE3 expected = SE3::exp(delta) * read_pose_block(x.data());
    const SE3 found = read_pose_block(moved.data());
    EXPECT_TRUE(found.rotation.isApprox(expected.rotation, 1e-12));
    EXPECT_TRUE(found.translation.isApprox(expected.translation, 1e-12));
    EXPECT_NEAR(Eigen::Map<const Eigen::Vector4d>(moved.data()).norm(), 1.0, 1e-14);
  }
}

TEST(PoseManifold, MinusUndoesPlusAndPlusUndoesMinus) {
  Random random(22);
  const PoseManifold manifold;
  for (int i = 0; i < 100; ++i) {
    const Block x = random_block(random);
    const Block y = random_block(random);
    const Vector6d delta = scenes::random_twist(random.uniform(), random.uniform(0.0, 3.0), random);
    Block moved{};
    Vector6d back;
    ASSERT_TRUE(manifold.Plus(x.data(), delta.data(), moved.data()));
    ASSERT_TRUE(manifold.Minus(moved.data(), x.data(), back.data()));
    EXPECT_LT((back - delta).norm(), 1e-9);

    ASSERT_TRUE(manifold.Minus(y.data(), x.data(), back.data()));
    ASSERT_TRUE(manifold.Plus(x.data(), back.data(), moved.data()));
    const SE3 expected = read_pose_block(y.data());
    EXPECT_TRUE(read_pose_block(moved.data()).rotation.isApprox(expected.rotation, 1e-9));
    EXPECT_TRUE(read_pose_block(moved.data()).translation.isApprox(expected.translation, 1e-9));
  }
}

TEST(PoseManifold, ZeroStepStays) {
  Random random(23);
  const Block x = random_block(random);
  const Vector6d zero = Vector6d::Zero();
  Block moved{};
  ASSERT_TRUE(PoseManifold().Plus(x.data(), zero.data(), moved.data()));
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(moved[i], x[i], 1e-15);
}

TEST(PoseManifold, JacobiansPickTheFirstSixColumns) {
  Random random(24);
  const PoseManifold manifold;
  const Block x = random_block(random);
  Eigen::Matrix<double, 7, 6, Eigen::RowMajor> plus;
  Eigen::Matrix<double, 6, 7, Eigen::RowMajor> minus;
  ASSERT_TRUE(manifold.PlusJacobian(x.data(), plus.data()));
  ASSERT_TRUE(manifold.MinusJacobian(x.data(), minus.data()));
  EXPECT_TRUE((minus * plus).isIdentity(0.0));

  const Eigen::Matrix<double, 3, 7, Eigen::RowMajor> ambient =
      Eigen::Matrix<double, 3, 7, Eigen::RowMajor>::Random();
  EXPECT_TRUE((ambient * plus).isApprox(ambient.leftCols<6>(), 0.0));
  Eigen::Matrix<double, 3, 6, Eigen::RowMajor> product;
  ASSERT_TRUE(manifold.RightMultiplyByPlusJacobian(x.data(), 3, ambient.data(), product.data()));
  EXPECT_TRUE(product.isApprox(ambient.leftCols<6>(), 0.0));
}

}  // namespace
}  // namespace cpslam
