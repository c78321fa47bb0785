#include <gtest/gtest.h>

#include <cmath>

#include "camera/depth_noise.h"
#include "sim/sensor.h"
#include "sim/simulation.h"

namespace cpslam::sim {
namespace {

RenderedView flat_view(double depth_m, double cosine = 1.0) {
  RenderedView view;
  const cv::Size size(640, 480);
  view.depth_m = cv::Mat(size, CV_32FC1, cv::Scalar(depth_m));
  view.cosine = cv::Mat(size, CV_32FC1, cv::Scalar(cosine));
  view.depth_return = cv::Mat(size, CV_8UC1, cv::Scalar(1));
  view.label = cv::Mat::zeros(size, CV_8UC1);
  return view;
}

struct Moments {
  double mean, sigma;
};

Moments moments_m(const cv::Mat& depth) {
  cv::Scalar mean, sigma;
  cv::meanStdDev(depth, mean, sigma, depth > 0);
  return {mean[0] / 5000.0, sigma[0] / 5000.0};
}

TEST(StructuredLight, NoiseHasThePromisedSigma) {
  for (const double depth_m : {0.7, 1.3, 2.1, 3.3, 4.7}) {
    Random random(1);
    const cv::Mat depth =
        structured_light_depth(flat_view(depth_m), SimulationOptions::default_camera(), random);
    const Moments moments = moments_m(depth);
    EXPECT_NEAR(moments.sigma, structured_light_sigma_m(depth_m), 0.15 * structured_light_sigma_m(depth_m))
        << depth_m;
    EXPECT_NEAR(moments.mean, depth_m, 0.3 * structured_light_sigma_m(depth_m) + 2e-4) << depth_m;
    EXPECT_GT(cv::countNonZero(depth), 640 * 480 * 99 / 100);
  }
}

TEST(StructuredLight, DepthsAreWholeEighthsOfDisparity) {
  Random random(2);
  const cv::Mat depth = structured_light_depth(flat_view(2.5), SimulationOptions::default_camera(), random);
  for (int x = 0; x < depth.cols; ++x) {
    const double units = depth.at<std::uint16_t>(100, x);
    if (units == 0.0) continue;
    const double eighths = 8.0 * 40.0 * 5000.0 / units;
    EXPECT_NEAR(eighths, std::round(eighths), 0.01);
  }
}

TEST(StructuredLight, NothingOutOfRangeAtGrazingAnglesOrOnGlass) {
  Random random(3);
  const CameraSettings camera = SimulationOptions::default_camera();
  EXPECT_EQ(cv::countNonZero(structured_light_depth(flat_view(0.35), camera, random)), 0);
  EXPECT_EQ(cv::countNonZero(structured_light_depth(flat_view(9.5), camera, random)), 0);
  EXPECT_EQ(cv::countNonZero(structured_light_depth(flat_view(2.0, 0.05), camera, random)), 0);
  RenderedView glass = flat_view(2.0);
  glass.depth_return.setTo(0);
  EXPECT_EQ(cv::countNonZero(structured_light_depth(glass, camera, random)), 0);
}

TEST(StructuredLight, NearThingsCastAShadowOfTheRightWidth) {
  RenderedView view = flat_view(3.0);
  view.depth_m.colRange(400, 640).setTo(1.0);
  Random random(4);
  const cv::Mat depth = structured_light_depth(view, SimulationOptions::default_camera(), random);
  const int holes = 480 * 100 - cv::countNonZero(depth.colRange(310, 410));
  // 40 px m * (1/1 m - 1/3 m) of background is hidden from the projector.
  EXPECT_NEAR(holes / 480.0, 26.7, 1.5);
}

TEST(Colour, NoiseHasThePromisedSigma) {
  for (const double value : {40.0, 120.0, 200.0}) {
    Random random(5);
    const cv::Mat developed =
        develop_colour(cv::Mat(480, 640, CV_32FC3, cv::Scalar::all(value)), 1.0, true, random);
    cv::Scalar mean, sigma;
    cv::meanStdDev(developed, mean, sigma);
    const double expected = std::sqrt(1.0 + 0.02 * value + 1.0 / 12.0);  // with rounding to whole levels
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(mean[i], value, 0.1);
      EXPECT_NEAR(sigma[i], expected, 0.05);
    }
  }
}

TEST(Colour, ExposureDriftChangesBrightnessOnly) {
  SimulationOptions options;
  options.preset = "office_static";
  Simulation plain(options);
  options.exposure_drift = true;
  Simulation drifting(options);
  double darkest = 1e9, brightest = 0.0;
  for (int i = 0; i < 240; i += 30) {
    const SimulatedFrame a = plain.render(i);
    const SimulatedFrame b = drifting.render(i);
    EXPECT_EQ(cv::norm(a.depth, b.depth, cv::NORM_INF), 0.0);
    const double ratio = cv::mean(b.colour_bgr)[1] / cv::mean(a.colour_bgr)[1];
    darkest = std::min(darkest, ratio);
    brightest = std::max(brightest, ratio);
  }
  EXPECT_GT(brightest - darkest, 0.15);
  EXPECT_GT(darkest, 0.7);
  EXPECT_LT(brightest, 1.3);
}

// Sum of squared differences of neighbours: what blur takes away.
double sharpness(const cv::Mat& image) {
  return cv::norm(image.colRange(1, image.cols), image.colRange(0, image.cols - 1), cv::NORM_L2SQR);
}

TEST(Colour, MotionBlursColourButNotDepth) {
  SimulationOptions options;
  options.preset = "office_rpy";
  Simulation sharp(options);
  options.motion_blur = true;
  Simulation blurred(options);
  int fastest = 1;
  double most = 0.0;
  for (int i = 1; i < 200; ++i) {
    const double turn = rotation_angle(sharp.world_from_camera(i - 1).rotation.transpose() *
                                       sharp.world_from_camera(i).rotation);
    if (turn > most) {
      most = turn;
      fastest = i;
    }
  }
  const SimulatedFrame a = sharp.render(fastest);
  const SimulatedFrame b = blurred.render(fastest);
  EXPECT_LT(sharpness(b.colour_bgr), 0.7 * sharpness(a.colour_bgr));
  EXPECT_EQ(cv::norm(a.depth, b.depth, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace cpslam::sim
