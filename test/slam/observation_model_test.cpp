#include "slam/observation_model.h"

#include <gtest/gtest.h>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;
using synthetic::Spot;

TEST(ObservationModel, PixelNoiseGrowsWithTheLevel) {
  const auto features = synthetic::make_features(std::vector<Spot>{
      {.x = 10.0, .y = 20.0, .descriptor = {}}, {.x = 30.0, .y = 40.0, .descriptor = {}, .octave = 3}});
  const PointObservation fine = observe(kRig, *features, 0);
  EXPECT_EQ(fine.uv, Eigen::Vector2d(10.0, 20.0));
  EXPECT_FALSE(fine.has_depth());
  EXPECT_DOUBLE_EQ(fine.sigma_px, 1.0);
  EXPECT_EQ(chi2_gate(fine), kChi2Mono);
  EXPECT_NEAR(observe(kRig, *features, 1).sigma_px, std::pow(1.2, 3), 1e-6);
}

TEST(ObservationModel, DisparityIsTheSensorsOrAFloor) {
  auto features = synthetic::make_features(
      std::vector<Spot>{{.x = 10.0, .y = 20.0, .descriptor = {}, .depth_m = 2.0, .octave = 1}});
  features->depth_sigma_m = {0.001F};
  const PointObservation exact = observe(kRig, *features, 0);
  EXPECT_DOUBLE_EQ(exact.disparity, 20.0);
  EXPECT_EQ(chi2_gate(exact), kChi2Depth);
  features->depth_sigma_m = {2.0F};
  // d(bf / z) = bf / z^2 dz = 10 px / m * 2 m.
  EXPECT_NEAR(observe(kRig, *features, 0).sigma_disparity_px, 20.0, 1e-5);
  EXPECT_LT(exact.sigma_disparity_px, 20.0);
  EXPECT_GT(exact.sigma_disparity_px, 10.0 * 0.001) << "no corner's depth is as good as the sensor on a wall";
}

TEST(ObservationModel, BackProjectInvertsProjection) {
  const auto features =
      synthetic::make_features(std::vector<Spot>{{.x = 100.0, .y = 200.0, .descriptor = {}, .depth_m = 2.5}});
  const Eigen::Vector3d point = back_project(kRig, *features, 0);
  EXPECT_DOUBLE_EQ(point.z(), 2.5);
  EXPECT_LT((kRig.camera.project(point) - Eigen::Vector2d(100.0, 200.0)).norm(), 1e-9);
  EXPECT_NEAR(chi2(kRig, observe(kRig, *features, 0), point), 0.0, 1e-12);
}

TEST(ObservationModel, ChiSquareAddsWhitenedErrors) {
  PointObservation seen;
  const Eigen::Vector3d point(0.0, 0.0, 2.0);
  seen.uv = kRig.camera.project(point) + Eigen::Vector2d(3.0, -4.0);
  seen.sigma_px = 2.0;
  EXPECT_NEAR(chi2(kRig, seen, point), 25.0 / 4.0, 1e-9);
  seen.disparity = 26.0;  // 20 at 2 m
  seen.sigma_disparity_px = 3.0;
  EXPECT_NEAR(chi2(kRig, seen, point), 25.0 / 4.0 + 4.0, 1e-9);
  EXPECT_TRUE(std::isinf(chi2(kRig, seen, {0.0, 0.0, 0.0})));
  EXPECT_TRUE(std::isinf(chi2(kRig, seen, {0.0, 0.0, -2.0})));
}

TEST(ObservationModel, OctaveFollowsTheDistance) {
  // Seen at octave 3 from 2 m.
  const auto max_distance_m = static_cast<float>(2.0 * std::pow(1.2, 3));
  EXPECT_EQ(predict_octave(kRig, 2.0, max_distance_m), 3);
  EXPECT_EQ(predict_octave(kRig, 2.0 * 1.2, max_distance_m), 2);
  EXPECT_EQ(predict_octave(kRig, 2.0 / 1.2, max_distance_m), 4);
  EXPECT_EQ(predict_octave(kRig, 2.0 * 1.08, max_distance_m), 3) << "rounded";
  EXPECT_EQ(predict_octave(kRig, 100.0, max_distance_m), 0);
  EXPECT_EQ(predict_octave(kRig, 0.01, max_distance_m), 7);
}

}  // namespace
}  // namespace cpslam
