#include "features/keypoint_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "util/random.h"

namespace cpslam {
namespace {

constexpr std::array<double, 4> kBounds{-12.5, -7.0, 655.0, 488.0};

std::vector<Keypoint> random_keypoints(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Keypoint> keypoints(n);
  for (Keypoint& k : keypoints) {
    // Beyond the bounds too.
    k.x = static_cast<float>(random.uniform(-60.0, 700.0));
    k.y = static_cast<float>(random.uniform(-60.0, 540.0));
    k.octave = static_cast<int>(random.index(8));
  }
  return keypoints;
}

std::vector<int> by_looking_at_all(const std::vector<Keypoint>& keypoints, float x, float y, float radius,
                                   int min_octave, int max_octave) {
  std::vector<int> found;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const Keypoint& k = keypoints[i];
    const bool inside = std::abs(k.x - x) <= radius && std::abs(k.y - y) <= radius;
    if (inside && k.octave >= min_octave && k.octave <= max_octave) found.push_back(static_cast<int>(i));
  }
  return found;
}

TEST(KeypointGrid, FindsWhatLookingAtAllFinds) {
  const std::vector<Keypoint> keypoints = random_keypoints(1000, 1);
  const KeypointGrid grid(keypoints, kBounds);
  Random random(2);
  std::size_t n_found = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto x = static_cast<float>(random.uniform(-100.0, 750.0));
    const auto y = static_cast<float>(random.uniform(-100.0, 600.0));
    const auto radius = static_cast<float>(random.uniform(0.0, 60.0));
    const int min_octave = static_cast<int>(random.index(8));
    const int max_octave = min_octave + static_cast<int>(random.index(3));
    std::vector<int> found;
    grid.query(x, y, radius, min_octave, max_octave, found);
    n_found += found.size();
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, by_looking_at_all(keypoints, x, y, radius, min_octave, max_octave));
  }
  EXPECT_GT(n_found, 1000U);
}

TEST(KeypointGrid, AppendsInAFixedOrder) {
  // Two keypoints in the first cell, one in the cell to the right, one below.
  const std::vector<Keypoint> keypoints{
      {.x = 5, .y = 15}, {.x = 15, .y = 5}, {.x = 6, .y = 2}, {.x = 1, .y = 9}};
  const KeypointGrid grid(keypoints, {0.0, 0.0, 100.0, 100.0});
  std::vector<int> found{77};
  grid.query(5.0F, 5.0F, 20.0F, 0, 7, found);
  EXPECT_EQ(found, (std::vector<int>{77, 2, 3, 1, 0}));
}

TEST(KeypointGrid, TheWindowIsSquareAndClosed) {
  const std::vector<Keypoint> keypoints{{.x = 50, .y = 50}};
  const KeypointGrid grid(keypoints, {0.0, 0.0, 100.0, 100.0});
  const auto n_found = [&grid](float x, float y, float radius) {
    std::vector<int> found;
    grid.query(x, y, radius, 0, 0, found);
    return found.size();
  };
  EXPECT_EQ(n_found(60.0F, 40.0F, 10.0F), 1U);
  EXPECT_EQ(n_found(60.5F, 50.0F, 10.0F), 0U);
  EXPECT_EQ(n_found(50.0F, 39.5F, 10.0F), 0U);
  EXPECT_EQ(n_found(50.0F, 50.0F, 0.0F), 1U);
}

TEST(KeypointGrid, SurvivesEmptinessAndNonsense) {
  std::vector<int> found;
  KeypointGrid().query(1.0F, 1.0F, 10.0F, 0, 7, found);
  KeypointGrid({}, kBounds).query(1.0F, 1.0F, 10.0F, 0, 7, found);
  EXPECT_TRUE(found.empty());
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const std::vector<Keypoint> keypoints = random_keypoints(100, 3);
  const KeypointGrid grid(keypoints, kBounds);
  grid.query(kNan, 10.0F, 10.0F, 0, 7, found);
  grid.query(10.0F, 10.0F, kNan, 0, 7, found);
  grid.query(10.0F, 10.0F, -5.0F, 0, 7, found);
  grid.query(1e30F, -1e30F, 5.0F, 0, 7, found);
  EXPECT_TRUE(found.empty());
  grid.query(10.0F, 10.0F, kInf, 0, 7, found);
  EXPECT_EQ(found.size(), 100U);
}

}  // namespace
}  // namespace cpslam
