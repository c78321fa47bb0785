#include "detect/sdf_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace cpslam {
namespace {

std::vector<DepthSample> normal_depths(int n, double mean_m, double sigma_m, Random& random) {
  std::vector<DepthSample> samples;
  for (int i = 0; i < n; ++i) samples.push_back({float(mean_m + sigma_m * random.normal()), 1.0F});
  return samples;
}

void append(std::vector<DepthSample>& to, const std::vector<DepthSample>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

SdfModel fit(const std::vector<DepthSample>& samples, std::uint64_t seed = 1) {
  Random random(seed);
  return fit_sdf_model(samples, random);
}

TEST(SdfModel, IsMeanAndDeviationOfCleanSamples) {
  Random random(3);
  const std::vector<DepthSample> samples = normal_depths(400, 2.2, 0.15, random);
  double sum = 0.0, squares = 0.0;
  for (const DepthSample& s : samples) sum += double(s.depth_m);
  const double mean = sum / 400.0;
  for (const DepthSample& s : samples) squares += std::pow(double(s.depth_m) - mean, 2);
  const SdfModel model = fit(samples);
  EXPECT_NEAR(double(model.mean_m), mean, 0.02);
  EXPECT_NEAR(double(model.sigma_m), std::sqrt(squares / 400.0), 0.03);
  EXPECT_GT(model.share, 0.9F);
}

TEST(SdfModel, SaysWhichDepthsBelongAndTheirShare) {
  Random random(4);
  std::vector<DepthSample> samples = normal_depths(300, 2.0, 0.1, random);
  append(samples, normal_depths(100, 4.0, 0.02, random));
  const SdfModel model = fit(samples);
  EXPECT_TRUE(model.contains(2.0F));
  EXPECT_TRUE(model.contains(2.15F));
  EXPECT_FALSE(model.contains(4.0F));
  EXPECT_FALSE(model.contains(3.0F));
  EXPECT_FALSE(model.contains(1.0F));
  double inside = 0.0;
  for (const DepthSample& s : samples) inside += model.contains(s.depth_m) ? 1.0 : 0.0;
  EXPECT_NEAR(double(model.share), inside / double(samples.size()), 0.02);
}

TEST(SdfModel, WeighsSamples) {
  // As many depths at either place; those with the weight make the model.
  Random random(5);
  std::vector<DepthSample> samples = normal_depths(100, 2.0, 0.1, random);
  append(samples, normal_depths(100, 3.5, 0.1, random));
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].weight = i < 100 ? 0.1F : 1.0F;
  EXPECT_NEAR(fit(samples).mean_m, 3.5F, 0.1F);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].weight = i < 100 ? 1.0F : 0.1F;
  EXPECT_NEAR(fit(samples).mean_m, 2.0F, 0.1F);
}

TEST(SdfModel, TakesTheNearerOfTwoLikeSurfaces) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    std::vector<DepthSample> samples = normal_depths(200, 2.0, 0.12, random);
    append(samples, normal_depths(200, 3.5, 0.12, random));
    EXPECT_NEAR(fit(samples, seed).mean_m, 2.0F, 0.1F) << seed;
  }
}

TEST(SdfModel, AThinWallDoesNotWinByItsDensity) {
  // Every reading of the wall at the same depth, those of the person spread over his.
  int found = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    std::vector<DepthSample> samples = normal_depths(200, 2.0, 0.12, random);
    append(samples, std::vector<DepthSample>(200, {3.5F, 1.0F}));
    found += std::abs(fit(samples, seed).mean_m - 2.0F) < 0.1F ? 1 : 0;
  }
  EXPECT_GE(found, 19);
}

TEST(SdfModel, AWallThatFillsMostOfTheBoxIsTheDominantSurface) {
  Random random(7);
  std::vector<DepthSample> samples = normal_depths(20, 2.0, 0.12, random);
  append(samples, normal_depths(380, 3.5, 0.02, random));
  EXPECT_NEAR(fit(samples).mean_m, 3.5F, 0.05F);
}

TEST(SdfModel, HasNoneWithoutSamples) {
  const SdfModel model = fit({});
  EXPECT_FALSE(model.valid());
}

TEST(SdfModel, OneSampleIsAModelOfItsOwn) {
  const SdfModel model = fit({{1.7F, 0.5F}});
  EXPECT_TRUE(model.valid());
  EXPECT_FLOAT_EQ(model.mean_m, 1.7F);
  EXPECT_FLOAT_EQ(model.share, 1.0F);
  EXPECT_GT(model.gate_m, 0.0F);
}

TEST(SdfModel, TwoNeighboursAreOneModel) {
  const SdfModel model = fit({{1.7F, 1.0F}, {1.8F, 1.0F}});
  EXPECT_TRUE(model.contains(1.7F));
  EXPECT_TRUE(model.contains(1.8F));
  EXPECT_NEAR(model.mean_m, 1.75F, 1e-4F);
}

TEST(SdfModel, TwoFarApartAreNotAveraged) {
  const SdfModel model = fit({{1.5F, 1.0F}, {4.5F, 1.0F}});
  ASSERT_TRUE(model.valid());
  EXPECT_NE(model.contains(1.5F), model.contains(4.5F));
}

TEST(SdfModel, EqualDepthsGiveAModelWithWidth) {
  const SdfModel model = fit(std::vector<DepthSample>(50, {2.5F, 1.0F}));
  EXPECT_FLOAT_EQ(model.mean_m, 2.5F);
  EXPECT_FLOAT_EQ(model.share, 1.0F);
  EXPECT_GT(model.sigma_m, 0.0F);
  EXPECT_LT(model.gate_m, 0.5F);
}

TEST(SdfModel, DepthsAllFarApartGiveFiniteNumbers) {
  std::vector<DepthSample> samples;
  for (int i = 1; i <= 10; ++i) samples.push_back({float(i), 1.0F});
  const SdfModel model = fit(samples);
  ASSERT_TRUE(model.valid());
  EXPECT_TRUE(std::isfinite(model.mean_m) && std::isfinite(model.sigma_m) && std::isfinite(model.gate_m));
  EXPECT_GE(model.mean_m, 1.0F);
  EXPECT_LE(model.mean_m, 10.0F);
  EXPECT_LT(model.share, 0.5F);
}

TEST(SdfModel, GrowsItsGateWithTheSensorsNoise) {
  const SdfModel near = fit(std::vector<DepthSample>(50, {1.0F, 1.0F}));
  const SdfModel far = fit(std::vector<DepthSample>(50, {9.0F, 1.0F}));
  EXPECT_GT(far.gate_m, near.gate_m);
}

TEST(SdfModel, DependsOnNothingButTheSeed) {
  Random random(8);
  std::vector<DepthSample> samples = normal_depths(100, 2.0, 0.2, random);
  append(samples, normal_depths(150, 3.0, 0.3, random));
  const SdfModel a = fit(samples, 11);
  const SdfModel b = fit(samples, 11);
  EXPECT_EQ(a.mean_m, b.mean_m);
  EXPECT_EQ(a.sigma_m, b.sigma_m);
  EXPECT_EQ(a.gate_m, b.gate_m);
  EXPECT_EQ(a.share, b.share);
}

TEST(SdfModel, FindsThePersonInRandomBoxes) {
  constexpr int kTrials = 400;
  int found = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(std::uint64_t(trial) + 1000);
    const double person_m = random.uniform(1.0, 4.0);
    const int n_person = 100 + int(random.index(200));
    std::vector<DepthSample> samples = normal_depths(n_person, person_m, random.uniform(0.08, 0.18), random);
    const int n_wall = int(random.index(std::size_t(n_person)));
    append(samples, normal_depths(n_wall, person_m + random.uniform(0.8, 3.0), 0.02, random));
    for (int i = 0; i < n_person / 10; ++i) samples.push_back({float(random.uniform(0.5, 8.0)), 1.0F});
    found += std::abs(double(fit(samples, std::uint64_t(trial)).mean_m) - person_m) < 0.05 ? 1 : 0;
  }
  EXPECT_GE(found, kTrials * 95 / 100);
}

}  // namespace
}  // namespace cpslam
