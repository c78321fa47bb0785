#include "slam/keyframe_culling.h"

#include <gtest/gtest.h>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

TEST(KeyFrameCulling, RedundantOnesGoTheRootAndTheCentreStay) {
  Random random(41);
  scene::MappedWorld mapped(200, scene::row_of_poses(8, 0.005), {}, random);
  const KeyFrameId centre = mapped.keyframes.back();
  cull_keyframes(kRig, mapped.map, centre);
  EXPECT_NE(mapped.map.keyframe(mapped.keyframes[0]), nullptr);
  EXPECT_NE(mapped.map.keyframe(centre), nullptr);
  // The last one that may go has three others beside it.
  EXPECT_EQ(mapped.map.n_keyframes(), 3U);
  EXPECT_GT(mapped.map.n_points(), 190U);
}

TEST(KeyFrameCulling, ThreeViewsAreNotRedundant) {
  Random random(42);
  scene::MappedWorld mapped(200, scene::row_of_poses(3, 0.005), {}, random);
  cull_keyframes(kRig, mapped.map, mapped.keyframes[1]);
  EXPECT_EQ(mapped.map.n_keyframes(), 3U);
}

TEST(KeyFrameCulling, OneThatSeesSomethingNewStays) {
  // The middle keyframe alone knows a fifth of its points.
  Random random(43);
  scene::MappedWorld mapped(200, {}, {}, random);
  const auto poses = scene::row_of_poses(6, 0.005);
  for (std::size_t i = 0; i < poses.size(); ++i) mapped.add_view(poses[i], {}, random, i == 3 ? 0 : 40);
  cull_keyframes(kRig, mapped.map, mapped.keyframes.back());
  EXPECT_NE(mapped.map.keyframe(mapped.keyframes[3]), nullptr);
  EXPECT_LT(mapped.map.n_keyframes(), 6U);
}

TEST(KeyFrameCulling, CoarserViewsDoNotReplaceAFineOne) {
  Random random(44);
  scene::MappedWorld mapped(200, {}, {}, random);
  const auto poses = scene::row_of_poses(6, 0.005);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    // All but the second see everything three levels coarser.
    if (i != 1) {
      for (double& distance_m : mapped.world.reference_distance_m) distance_m *= std::pow(1.2, 3);
    }
    mapped.add_view(poses[i], {}, random);
    if (i != 1) {
      for (double& distance_m : mapped.world.reference_distance_m) distance_m /= std::pow(1.2, 3);
    }
  }
  cull_keyframes(kRig, mapped.map, mapped.keyframes.back());
  EXPECT_NE(mapped.map.keyframe(mapped.keyframes[1]), nullptr);
  EXPECT_LT(mapped.map.n_keyframes(), 6U);
}

TEST(KeyFrameCulling, FarPointsDoNotCount) {
  Random random(45);
  scene::MappedWorld far(200, scene::row_of_poses(6, 0.005), {}, random, 4.0, 8.0);
  cull_keyframes(kRig, far.map, far.keyframes.back());
  EXPECT_EQ(far.map.n_keyframes(), 6U) << "nothing close, so nothing is known to be redundant";
  cull_keyframes(kRig, far.map, KeyFrameId{});
}

}  // namespace
}  // namespace cpslam
