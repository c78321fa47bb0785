#include "features/orb_orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "features/image_pyramid.h"
#include "test_images.h"

namespace cpslam {
namespace {

cv::Mat padded(const cv::Mat& image, ImagePyramid& pyramid) {
  pyramid.build(image);
  return pyramid.level(0);
}

TEST(OrbOrientation, MomentsAreThoseOfTheDisc) {
  constexpr int kHalf[16] = {15, 15, 15, 15, 14, 14, 14, 13, 13, 12, 11, 10, 9, 8, 6, 3};
  ImagePyramid pyramid(1.2, 1);
  for (const cv::Mat& image : {test::noise_image(64, 48, 1), cv::Mat(48, 64, CV_8UC1, cv::Scalar(255))}) {
    const cv::Mat level = padded(image, pyramid);
    for (const Simd simd : test::simds()) {
      for (int x = 19; x < 45; x += 5) {
        int m10 = 0;
        int m01 = 0;
        for (int v = -15; v <= 15; ++v) {
          for (int u = -kHalf[std::abs(v)]; u <= kHalf[std::abs(v)]; ++u) {
            m10 += u * level.at<std::uint8_t>(22 + v, x + u);
            m01 += v * level.at<std::uint8_t>(22 + v, x + u);
          }
        }
        const PatchMoments m = patch_moments(level, x, 22, simd);
        EXPECT_EQ(m.m10, m10);
        EXPECT_EQ(m.m01, m01);
      }
    }
  }
}

TEST(OrbOrientation, ExtremeContrastsDoNotOverflow) {
  ImagePyramid pyramid(1.2, 1);
  cv::Mat image(60, 60, CV_8UC1, cv::Scalar(0));
  image.rowRange(31, 60).setTo(255);
  const cv::Mat level = padded(image, pyramid);
  for (const Simd simd : test::simds()) {
    const PatchMoments m = patch_moments(level, 30, 30, simd);
    EXPECT_EQ(m.m10, 0);
    // Sum of v * (2 * half width + 1) over the rows below, times 255.
    EXPECT_EQ(m.m01,
              255 * (31 + 62 + 93 + 116 + 145 + 174 + 189 + 216 + 225 + 230 + 231 + 228 + 221 + 182 + 105));
  }
}

TEST(OrbOrientation, PointsUpTheSlopeOfLight) {
  ImagePyramid pyramid(1.2, 1);
  for (int degrees = 0; degrees < 360; degrees += 15) {
    const double angle = degrees * std::numbers::pi / 180.0;
    cv::Mat image(60, 60, CV_8UC1);
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 60; ++x) {
        const double light = 128.0 + 4.0 * ((x - 30) * std::cos(angle) + (y - 30) * std::sin(angle));
        image.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(light);
      }
    }
    std::vector<float> angles;
    orient_corners(padded(image, pyramid), {{30, 30, 50}}, best_simd(), angles);
    ASSERT_EQ(angles.size(), 1U);
    const double error = std::remainder(static_cast<double>(angles[0]) - degrees, 360.0);
    EXPECT_LT(std::abs(error), 1.0) << degrees;
    EXPECT_GE(angles[0], 0.0F);
    EXPECT_LT(angles[0], 360.0F);
  }
}

}  // namespace
}  // namespace cpslam
