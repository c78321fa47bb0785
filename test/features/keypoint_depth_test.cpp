#include "features/keypoint_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "camera/depth_noise.h"
#include "util/random.h"

namespace cpslam {
namespace {

constexpr float kNone = 0.0F;

/// Reads the centre of an 11 x 11 depth image (m) given as a function of the offset from it.
DepthReading read(const std::function<float(int dx, int dy)>& depth_m) {
  cv::Mat image(11, 11, CV_32FC1);
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 11; ++x) image.at<float>(y, x) = depth_m(x - 5, y - 5);
  }
  return read_keypoint_depth(image, 1.0, 5, 5);
}

float sensor_sigma(float depth_m) {
  return static_cast<float>(structured_light_sigma_m(static_cast<double>(depth_m)));
}

TEST(KeypointDepth, AFlatSurfaceGivesTheSensorsReading) {
  const DepthReading r = read([](int, int) { return 2.0F; });
  EXPECT_FLOAT_EQ(r.depth_m, 2.0F);
  EXPECT_FLOAT_EQ(r.sigma_m, sensor_sigma(2.0F));
}

TEST(KeypointDepth, ASlantedSurfaceKeepsTheCentreAndLosesCertainty) {
  const DepthReading r = read([](int dx, int) { return 2.0F + 0.02F * static_cast<float>(dx); });
  EXPECT_FLOAT_EQ(r.depth_m, 2.0F);
  EXPECT_NEAR(r.sigma_m, std::hypot(sensor_sigma(2.0F), 0.01F), 1e-5F);  // half a pixel of 0.02 m per px
}

TEST(KeypointDepth, ASteepSurfaceIsNotAnEdge) {
  const DepthReading r = read([](int dx, int) { return 2.0F + 0.1F * static_cast<float>(dx); });
  EXPECT_FLOAT_EQ(r.depth_m, 2.0F);
  EXPECT_NEAR(r.sigma_m, 0.05F, 0.01F);
}

TEST(KeypointDepth, AnEdgeBelongsToTheNearSurface) {
  // The near surface has two of five columns, the centre reading is on the far one.
  const DepthReading r = read([](int dx, int) { return dx < 0 ? 1.0F : 3.0F; });
  EXPECT_FLOAT_EQ(r.depth_m, 1.0F);
  EXPECT_FLOAT_EQ(r.sigma_m, 2.0F * sensor_sigma(1.0F));
  // And the same with the centre on the near one.
  EXPECT_FLOAT_EQ(read([](int dx, int) { return dx <= 0 ? 1.0F : 3.0F; }).depth_m, 1.0F);
}

TEST(KeypointDepth, AReadingBetweenTwoSurfacesDoesNotHideTheEdge) {
  const DepthReading r = read([](int dx, int dy) {
    if (dx == 0 && dy == 0) return 2.0F;
    return dx < 0 ? 1.0F : 3.0F;
  });
  EXPECT_FLOAT_EQ(r.depth_m, 1.0F);
}

TEST(KeypointDepth, AFewNearReadingsAreOutliers) {
  const DepthReading r = read([](int dx, int dy) { return dx == -2 && dy < 0 ? 1.0F : 3.0F; });
  EXPECT_FLOAT_EQ(r.depth_m, 3.0F);
  EXPECT_FLOAT_EQ(r.sigma_m, 2.0F * sensor_sigma(3.0F));
}

TEST(KeypointDepth, AHoleIsFilledFromAConsistentNeighbourhood) {
  const DepthReading r = read([](int dx, int) { return dx < 0 ? 1.5F : kNone; });  // 10 of 25
  EXPECT_FLOAT_EQ(r.depth_m, 1.5F);
  EXPECT_FLOAT_EQ(r.sigma_m, 2.0F * sensor_sigma(1.5F));
}

TEST(KeypointDepth, AHoleAtAnEdgeIsFilledFromTheNearSurface) {
  const DepthReading r = read([](int dx, int) { return dx < 0 ? 1.5F : dx == 0 ? kNone : 4.0F; });
  EXPECT_FLOAT_EQ(r.depth_m, 1.5F);
}

TEST(KeypointDepth, AHoleWithTooLittleAroundItStaysAHole) {
  EXPECT_EQ(read([](int dx, int) { return dx == -2 ? 1.5F : kNone; }).depth_m, 0.0F);  // 5 of 25
  // Enough readings, but neither surface fills 30 %: 5 near, 5 far.
  EXPECT_EQ(read([](int dx, int) { return dx == -2 ? 1.5F : dx == 2 ? 4.0F : kNone; }).depth_m, 0.0F);
  EXPECT_EQ(read([](int, int) { return kNone; }).sigma_m, 0.0F);
}

TEST(KeypointDepth, ALoneReadingAtTheCentreCounts) {
  const DepthReading r = read([](int dx, int dy) { return dx == 0 && dy == 0 ? 1.25F : kNone; });
  EXPECT_FLOAT_EQ(r.depth_m, 1.25F);
  EXPECT_FLOAT_EQ(r.sigma_m, sensor_sigma(1.25F));
}

TEST(KeypointDepth, NoiseAloneIsNoEdge) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const float z = static_cast<float>(random.uniform(0.5, 5.0));
    float centre = 0.0F;
    const DepthReading r = read([&](int dx, int dy) {
      const float noisy = z + sensor_sigma(z) * static_cast<float>(random.normal());
      if (dx == 0 && dy == 0) centre = noisy;
      return noisy;
    });
    EXPECT_FLOAT_EQ(r.depth_m, centre);
    EXPECT_LT(r.sigma_m, 2.0F * sensor_sigma(centre) + 1e-4F);
  }
}

TEST(KeypointDepth, NonsenseIsNoReading) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  for (const float bad : {kNan, kInf, -kInf, -2.0F, 0.0F}) {
    EXPECT_EQ(read([bad](int, int) { return bad; }).depth_m, 0.0F) << bad;
    EXPECT_FLOAT_EQ(read([bad](int dx, int) { return dx == 1 ? bad : 2.0F; }).depth_m, 2.0F) << bad;
  }
}

TEST(KeypointDepth, ReadsRawUnitsAndTheImagesCorners) {
  cv::Mat image(20, 20, CV_16UC1, cv::Scalar(0));
  image.at<std::uint16_t>(0, 0) = 5000;
  image.at<std::uint16_t>(19, 19) = 10000;
  EXPECT_FLOAT_EQ(read_keypoint_depth(image, 1.0 / 5000.0, 0, 0).depth_m, 1.0F);
  EXPECT_FLOAT_EQ(read_keypoint_depth(image, 1.0 / 5000.0, 19, 19).depth_m, 2.0F);
  EXPECT_EQ(read_keypoint_depth(image, 1.0 / 5000.0, 10, 10).depth_m, 0.0F);
}

}  // namespace
}  // namespace cpslam
