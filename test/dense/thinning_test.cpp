#include "dense/thinning.h"

#include <gtest/gtest.h>

namespace cpslam {
namespace {

constexpr float kSideM = 0.02F;

Voxel voxel(const Eigen::Vector3i& cell, const Eigen::Vector3f& normal, float weight) {
  Voxel v;
  v.cell = cell;
  v.position_m = (cell.cast<float>().array() + 0.5F) * kSideM;
  v.normal = normal.normalized();
  v.rgb = Eigen::Vector3f::Constant(weight);
  v.weight = weight;
  return v;
}

TEST(Thinning, OneLayerStaysAtTheMeanOfAll) {
  const Eigen::Vector3f up(0.1F, 0.0F, 1.0F);
  const std::vector<Voxel> thinned =
      thin({voxel({0, 0, 0}, up, 1.0F), voxel({0, 0, 1}, up, 5.0F), voxel({0, 0, 2}, up, 2.0F)});
  ASSERT_EQ(thinned.size(), 1U);
  EXPECT_EQ(thinned[0].cell, Eigen::Vector3i(0, 0, 1));
  EXPECT_NEAR(thinned[0].position_m.z(), kSideM * (0.5F * 1.0F + 1.5F * 5.0F + 2.5F * 2.0F) / 8.0F, 1e-6F);
  EXPECT_FLOAT_EQ(thinned[0].weight, 8.0F);
  EXPECT_FLOAT_EQ(thinned[0].rgb.x(), (1.0F + 25.0F + 4.0F) / 8.0F);
}

TEST(Thinning, OfEqualLayersOneStays) {
  const Eigen::Vector3f up(0.0F, 0.0F, 1.0F);
  EXPECT_EQ(thin({voxel({0, 0, 0}, up, 3.0F), voxel({0, 0, 1}, up, 3.0F)}).size(), 1U);
}

TEST(Thinning, BothSidesOfABoardAndNeighboursAlongItStay) {
  const Eigen::Vector3f up(0.0F, 0.0F, 1.0F);
  EXPECT_EQ(thin({voxel({0, 0, 0}, -up, 3.0F), voxel({0, 0, 1}, up, 1.0F)}).size(), 2U);
  EXPECT_EQ(thin({voxel({0, 0, 0}, up, 3.0F), voxel({1, 0, 0}, up, 1.0F)}).size(), 2U);
  EXPECT_EQ(thin({voxel({0, 0, 0}, up, 3.0F), voxel({0, 0, 3}, up, 1.0F)}).size(), 2U) << "another surface";
}

}  // namespace
}  // namespace cpslam
