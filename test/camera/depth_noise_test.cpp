#include "camera/depth_noise.h"

#include <gtest/gtest.h>

namespace cpslam {
namespace {

TEST(DepthNoise, FollowsThePublishedCurve) {
  EXPECT_DOUBLE_EQ(structured_light_sigma_m(0.4), 0.0012);
  EXPECT_NEAR(structured_light_sigma_m(1.4), 0.0031, 1e-12);
  EXPECT_NEAR(structured_light_sigma_m(4.0), 0.0012 + 0.0019 * 12.96, 1e-12);
}

TEST(DepthNoise, GrowsWithTheDistance) {
  for (double depth_m = 0.4; depth_m < 8.0; depth_m += 0.1) {
    EXPECT_LT(structured_light_sigma_m(depth_m), structured_light_sigma_m(depth_m + 0.1));
  }
}

}  // namespace
}  // namespace cpslam
