#include "slam/pose_ransac.h"

#include <gtest/gtest.h>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

struct Scene {
  synthetic::View view;
  std::vector<PoseHypothesisMatch> matches;
  std::vector<bool> right;
};

/// n matches, the first of a camera somewhere to a world; a share of them to points of other keypoints.
Scene make_scene(std::size_t n, double outlier_share, double depth_share, Random& random) {
  const synthetic::World world = synthetic::random_world(3 * n, random);
  Scene scene;
  const SE3 pose = synthetic::moved({}, {0.3, -0.1, 0.2}, 0.2);
  scene.view = synthetic::look(world, pose, {.depth_share = depth_share, .noise_px = 0.5}, random);
  const std::size_t seen = scene.view.point_of.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool right = random.uniform() >= outlier_share;
    const std::size_t shown = right ? i : (i + 1 + random.index(seen - 1)) % seen;
    scene.matches.push_back(
        {static_cast<int>(i), world.points[static_cast<std::size_t>(scene.view.point_of[shown])]});
    scene.right.push_back(right);
  }
  return scene;
}

TEST(PoseRansac, FindsThePoseAmongSixtyPercentOutliers) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const Scene scene = make_scene(100, 0.6, 0.8, random);
    const auto found = ransac_pose(kRig, *scene.view.features, scene.matches, 12, random);
    ASSERT_TRUE(found.has_value()) << seed;
    EXPECT_LT(synthetic::distance(found->cam_from_world, scene.view.cam_from_world), 0.05) << seed;
    std::size_t right_found = 0;
    for (const std::size_t i : found->inliers) right_found += scene.right[i] ? 1U : 0U;
    const auto right = static_cast<double>(std::count(scene.right.begin(), scene.right.end(), true));
    EXPECT_GT(static_cast<double>(right_found), 0.8 * right) << seed;
    EXPECT_LE(found->inliers.size() - right_found, 3U) << seed;
  }
}

TEST(PoseRansac, SameSeedSameAnswer) {
  Random random(7);
  const Scene scene = make_scene(80, 0.5, 0.8, random);
  Random first(42);
  Random second(42);
  const auto a = ransac_pose(kRig, *scene.view.features, scene.matches, 12, first);
  const auto b = ransac_pose(kRig, *scene.view.features, scene.matches, 12, second);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->inliers, b->inliers);
  EXPECT_EQ(a->cam_from_world.rotation, b->cam_from_world.rotation);
  EXPECT_EQ(a->cam_from_world.translation, b->cam_from_world.translation);
}

TEST(PoseRansac, NothingWithoutThreeDepths) {
  Random random(8);
  Scene scene = make_scene(40, 0.0, 0.0, random);
  EXPECT_FALSE(ransac_pose(kRig, *scene.view.features, scene.matches, 12, random).has_value());
  EXPECT_FALSE(ransac_pose(kRig, *scene.view.features, {}, 0, random).has_value());
}

TEST(PoseRansac, NothingWithTooFewInliers) {
  Random random(9);
  const Scene good = make_scene(11, 0.0, 1.0, random);
  EXPECT_FALSE(ransac_pose(kRig, *good.view.features, good.matches, 12, random).has_value());
  EXPECT_TRUE(ransac_pose(kRig, *good.view.features, good.matches, 9, random).has_value());
  const Scene noise = make_scene(60, 1.0, 1.0, random);
  EXPECT_FALSE(ransac_pose(kRig, *noise.view.features, noise.matches, 12, random).has_value());
}

TEST(PoseRansac, DegenerateSamplesMakeNoPose) {
  // All points on one line: a pose would be free to turn about it.
  synthetic::World world;
  Random random(10);
  for (int i = 0; i < 30; ++i) {
    world.points.emplace_back(-0.5 + 0.03 * i, 0.1, 2.0);
    world.descriptors.push_back(synthetic::random_descriptor(random));
    world.reference_distance_m.push_back(2.0);
  }
  const synthetic::View view = synthetic::look(world, {}, {}, random);
  std::vector<PoseHypothesisMatch> matches;
  for (std::size_t i = 0; i < view.point_of.size(); ++i) {
    matches.push_back({static_cast<int>(i), world.points[static_cast<std::size_t>(view.point_of[i])]});
  }
  EXPECT_FALSE(ransac_pose(kRig, *view.features, matches, 12, random).has_value());
}

}  // namespace
}  // namespace cpslam
