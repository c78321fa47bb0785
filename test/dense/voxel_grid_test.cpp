#include "dense/voxel_grid.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "util/random.h"

namespace cpslam {
namespace {

const Eigen::Vector3f kUp(0.0F, 0.0F, 1.0F);

TEST(VoxelGrid, MeansAreWeighted) {
  VoxelGrid grid(0.1);
  grid.add({0.31, -0.02, 0.0}, kUp, {10, 20, 30}, 1.0F);
  grid.add({0.35, -0.06, 0.04}, {1.0F, 0.0F, 0.0F}, {50, 60, 70}, 3.0F);
  const std::vector<Voxel> voxels = grid.voxels();
  ASSERT_EQ(voxels.size(), 1U);
  EXPECT_EQ(voxels[0].cell, Eigen::Vector3i(3, -1, 0));
  EXPECT_LT((voxels[0].position_m - Eigen::Vector3f(0.34F, -0.05F, 0.03F)).norm(), 1e-6F);
  EXPECT_LT((voxels[0].normal - Eigen::Vector3f(3.0F, 0.0F, 1.0F).normalized()).norm(), 1e-6F);
  EXPECT_LT((voxels[0].rgb - Eigen::Vector3f(40.0F, 50.0F, 60.0F)).norm(), 1e-4F);
  EXPECT_FLOAT_EQ(voxels[0].weight, 4.0F);
}

TEST(VoxelGrid, KeysAreUniqueOverTheWholeRange) {
  std::set<VoxelKey> keys;
  constexpr int kEnd = (1 << 20) - 1;
  for (const int x : {-kEnd, -1, 0, 1, kEnd}) {
    for (const int y : {-kEnd, -1, 0, 1, kEnd}) {
      for (const int z : {-kEnd, -1, 0, 1, kEnd}) EXPECT_TRUE(keys.insert(voxel_key({x, y, z})).second);
    }
  }
}

TEST(VoxelGrid, WhatIsNowhereOrTooFarIsLeftOut) {
  VoxelGrid grid(0.01);
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double x : {kInf, -kInf, std::numeric_limits<double>::quiet_NaN(), 1e300, 10485.77, -10485.77})
    grid.add({x, 0.0, 0.0}, kUp, {}, 1.0F);
  EXPECT_TRUE(grid.voxels().empty());
  grid.add({10485.0, -10485.0, 0.0}, kUp, {}, 1.0F);
  ASSERT_EQ(grid.voxels().size(), 1U);
  EXPECT_NEAR(grid.voxels()[0].position_m.x(), 10485.0F, 0.002F);
}

TEST(VoxelGrid, OrderDoesNotDependOnTheOrderOfAdding) {
  Random random(7);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 3000; ++i)
    points.emplace_back(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
  VoxelGrid forward(0.05), backward(0.05);
  for (std::size_t i = 0; i < points.size(); ++i) {
    forward.add(points[i], kUp, {}, 1.0F);
    backward.add(points[points.size() - 1 - i], kUp, {}, 1.0F);
  }
  const std::vector<Voxel> a = forward.voxels(), b = backward.voxels();
  ASSERT_EQ(a.size(), b.size());
  std::set<std::array<int, 3>> blocks;
  std::array<int, 3> last{1000, 1000, 1000};
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].cell, b[i].cell);
    const std::array<int, 3> block{a[i].cell.x() >> 3, a[i].cell.y() >> 3, a[i].cell.z() >> 3};
    if (block == last) continue;
    ASSERT_TRUE(blocks.insert(block).second) << "a block comes twice";
    last = block;
  }
}

}  // namespace
}  // namespace cpslam
