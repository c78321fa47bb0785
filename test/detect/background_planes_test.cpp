#include "detect/background_planes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "camera/depth_noise.h"
#include "detect/depth_scene.h"

namespace cpslam {
namespace {

using scene::DepthScene;
using scene::View;

const cv::Rect kBox(60, 30, 35, 70);

std::vector<GridPlane> find(const cv::Mat1f& depth_m, const cv::Rect& box = kBox, std::uint64_t seed = 1) {
  Random random(seed);
  return find_background_planes(depth_m, box, random);
}

/// Share of a rectangle's cells that lie on one of the planes.
double explained(const std::vector<GridPlane>& planes, const cv::Mat1f& depth_m, const cv::Rect& area) {
  int on = 0;
  for (int y = area.y; y < area.br().y; ++y) {
    for (int x = area.x; x < area.br().x; ++x) {
      on += std::any_of(planes.begin(), planes.end(),
                        [&](const GridPlane& p) { return p.contains(x, y, depth_m(y, x)); })
                ? 1
                : 0;
    }
  }
  return double(on) / double(area.area());
}

TEST(BackgroundPlanes, InverseDepthOfAPlaneIsLinearInTheImage) {
  const GridCamera camera = scene::grid_camera();
  const View view = DepthScene().plane({Eigen::Vector3f(0.3F, 0.4F, 1.0F).normalized(), 2.5F}).look(camera);
  const auto inverse = [&](int x, int y) { return 1.0 / double(view.depth_m(y, x)); };
  const double per_column = (inverse(159, 0) - inverse(0, 0)) / 159.0;
  const double per_row = (inverse(0, 119) - inverse(0, 0)) / 119.0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x)
      ASSERT_NEAR(inverse(x, y), inverse(0, 0) + per_column * x + per_row * y, 1e-5);
  }
}

TEST(BackgroundPlanes, FindsAWall) {
  const View view = DepthScene().wall(3.0F).look(scene::grid_camera());
  const std::vector<GridPlane> planes = find(view.depth_m);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_NEAR(1.0F / planes[0].inverse_depth(77, 65), 3.0F, 1e-3F);
  EXPECT_NEAR(1.0F / planes[0].inverse_depth(0, 119), 3.0F, 5e-3F);
}

TEST(BackgroundPlanes, FindsFloorAndWallToWithinTheNoise) {
  const GridCamera camera = scene::grid_camera();
  const View exact = DepthScene().wall(3.5F).floor().look(camera);
  int found = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    View view{exact.depth_m.clone(), exact.owner};
    Random random(seed);
    scene::add_noise(view, random);
    // The box ends where the floor is seen.
    const std::vector<GridPlane> planes = find(view.depth_m, cv::Rect(60, 40, 35, 72), seed);
    found += planes.size() >= 2 && explained(planes, exact.depth_m, {52, 32, 51, 88}) > 0.9 ? 1 : 0;
  }
  EXPECT_GE(found, 18);
}

TEST(BackgroundPlanes, TheFirstIsTheMostDominant) {
  const View view = DepthScene().wall(3.5F).floor().look(scene::grid_camera());
  const std::vector<GridPlane> planes = find(view.depth_m, cv::Rect(60, 20, 35, 80));
  ASSERT_GE(planes.size(), 1U);
  EXPECT_TRUE(planes[0].contains(77, 20, 3.5F));
}

TEST(BackgroundPlanes, AreFoundWithSomebodyElseBesideTheBox) {
  const GridCamera camera = scene::grid_camera();
  const View view =
      DepthScene().wall(3.5F).floor().person({2, {0.45F, scene::kCameraHeightM, 2.2F}}).look(camera);
  const cv::Rect box(60, 40, 35, 72);
  int found = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    // On the side where he is not.
    found += explained(find(view.depth_m, box, seed), view.depth_m, {40, 40, 20, 72}) > 0.9 ? 1 : 0;
  }
  EXPECT_GE(found, 85);
}

TEST(BackgroundPlanes, WhatGoesOnInsideTheBoxPlaysNoPart) {
  const GridCamera camera = scene::grid_camera();
  cv::Mat1f depth_m = DepthScene().wall(3.0F).look(camera).depth_m;
  depth_m(kBox).setTo(1.0F);
  const std::vector<GridPlane> planes = find(depth_m);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_TRUE(planes[0].contains(77, 65, 3.0F));
  EXPECT_FALSE(planes[0].contains(77, 65, 1.0F));
}

TEST(BackgroundPlanes, NoneInRandomDepths) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    cv::Mat1f depth_m(120, 160);
    for (float& d : depth_m) d = float(random.uniform(0.5, 8.0));
    EXPECT_TRUE(find(depth_m, kBox, seed).empty()) << seed;
  }
}

TEST(BackgroundPlanes, NoneWithoutDepthOrWithoutARing) {
  EXPECT_TRUE(find(cv::Mat1f(120, 160, 0.0F)).empty());
  EXPECT_TRUE(find(cv::Mat1f(120, 160, 2.0F), cv::Rect(0, 0, 160, 120)).empty());
}

TEST(BackgroundPlanes, AreTheSameForTheSameSeed) {
  View view = DepthScene().wall(3.5F).floor().look(scene::grid_camera());
  Random random(3);
  scene::add_noise(view, random);
  const std::vector<GridPlane> a = find(view.depth_m, kBox, 5);
  const std::vector<GridPlane> b = find(view.depth_m, kBox, 5);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(a[i].inverse_depth(10, 20), b[i].inverse_depth(10, 20));
}

TEST(GridPlane, ContainsReadingsWithinTheSensorsNoise) {
  const GridPlane plane{0.0F, 0.0F, 0.25F};
  EXPECT_TRUE(plane.contains(3, 4, 4.0F));
  EXPECT_TRUE(plane.contains(3, 4, 4.0F + float(structured_light_sigma_m(4.0))));
  EXPECT_FALSE(plane.contains(3, 4, 4.4F));
  EXPECT_FALSE(plane.contains(3, 4, 3.6F));
  // Beyond the horizon.
  EXPECT_FALSE((GridPlane{0.0F, 0.1F, -1.0F}).contains(0, 5, 2.0F));
}

}  // namespace
}  // namespace cpslam
