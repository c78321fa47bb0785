#include "slam/point_creation.h"

#include <gtest/gtest.h>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

constexpr std::size_t kUnlinked = 60;  // points of the world that the map does not know

/// Two keyframes `step` apart that share known points and see kUnlinked unknown ones.
struct TwoViews {
  TwoViews(const Eigen::Vector3d& step, const synthetic::ViewOptions& options, double min_depth_m = 1.2,
           double max_depth_m = 2.8)
      : mapped(200, {}, options, random, min_depth_m, max_depth_m) {
    mapped.add_view({}, options, random, kUnlinked);
    mapped.add_view(synthetic::moved({}, step), options, random, kUnlinked);
  }
  /// Unknown points that both see.
  [[nodiscard]] std::size_t in_both() const {
    std::size_t n = 0;
    for (std::size_t p = 0; p < kUnlinked; ++p) {
      n += mapped.views[0].keypoint_of[p] >= 0 && mapped.views[1].keypoint_of[p] >= 0 ? 1U : 0U;
    }
    return n;
  }
  /// The point of the world that the created one is, by both of its observations.
  [[nodiscard]] std::size_t truth_of(MapPointId id) const {
    std::size_t truth = mapped.world.points.size();
    for (std::size_t v = 0; v < 2; ++v) {
      const int keypoint = mapped.map.keypoint_of(id, mapped.keyframes[v]);
      EXPECT_GE(keypoint, 0);
      const auto p = static_cast<std::size_t>(mapped.views[v].point_of[static_cast<std::size_t>(keypoint)]);
      EXPECT_TRUE(v == 0 || p == truth) << "two different points were taken for one";
      truth = p;
    }
    return truth;
  }
  std::vector<MapPointId> create() { return create_points(kRig, mapped.map, mapped.keyframes[1]); }

  Random random{11};
  scene::MappedWorld mapped;
};

TEST(PointCreation, TriangulatesWhatHasParallax) {
  TwoViews views({0.15, 0.0, 0.0}, {.depth_share = 0.0});
  const std::vector<MapPointId> created = views.create();
  EXPECT_GT(created.size(), 0.9 * static_cast<double>(views.in_both()));
  for (const MapPointId id : created) {
    const std::size_t p = views.truth_of(id);
    EXPECT_LT((views.mapped.map.point(id)->position_in_world - views.mapped.world.points[p]).norm(), 1e-3);
    EXPECT_EQ(views.mapped.map.point(id)->first_sequence, 1U);
  }
}

TEST(PointCreation, WithoutParallaxItNeedsDepth) {
  // 8 to 12 m away and a step of 8 cm: half a degree.
  TwoViews blind({0.08, 0.0, 0.0}, {.depth_share = 0.0}, 8.0, 12.0);
  EXPECT_TRUE(blind.create().empty());
  TwoViews seeing({0.08, 0.0, 0.0}, {.depth_share = 1.0}, 8.0, 12.0);
  const std::vector<MapPointId> created = seeing.create();
  EXPECT_GT(created.size(), 0.9 * static_cast<double>(seeing.in_both()));
  for (const MapPointId id : created) {
    const std::size_t p = seeing.truth_of(id);
    EXPECT_LT((seeing.mapped.map.point(id)->position_in_world - seeing.mapped.world.points[p]).norm(), 1e-2);
  }
}

TEST(PointCreation, TooSmallAStepIsNotTried) {
  TwoViews views({0.001, 0.0, 0.0}, {.depth_share = 1.0});
  EXPECT_TRUE(views.create().empty());
}

TEST(PointCreation, RefusesKeypointsWhoseScaleDoesNotFit) {
  TwoViews views({0.15, 0.0, 0.0}, {.depth_share = 0.0});
  // A third camera that sees everything at a much coarser level than the distance would make it.
  synthetic::View view = synthetic::look(views.mapped.world, synthetic::moved({}, {0.3, 0.0, 0.0}),
                                         {.depth_share = 0.0}, views.random);
  auto wrong = std::make_shared<FrameFeatures>(*view.features);
  for (Keypoint& keypoint : wrong->keypoints) keypoint.octave = 7;
  view.features = wrong;
  Map& map = views.mapped.map;
  const KeyFrameId id = scene::add_keyframe(map, view);
  for (std::size_t p = kUnlinked; p < 200; ++p) {
    if (view.keypoint_of[p] >= 0) map.add_observation(views.mapped.points[p], {id, view.keypoint_of[p]});
  }
  map.update_covisibility(id);
  ASSERT_FALSE(map.best_covisible(id, 5).empty());
  EXPECT_TRUE(create_points(kRig, map, id).empty());
}

TEST(PointCreation, RefusesDepthThatContradictsTheRays) {
  TwoViews views({0.15, 0.0, 0.0}, {.depth_share = 1.0});
  // A third camera whose depths are half of what they should be; its pixels are right.
  synthetic::View liar = synthetic::look(views.mapped.world, synthetic::moved({}, {0.3, 0.0, 0.0}),
                                         {.depth_share = 1.0}, views.random);
  auto features = std::make_shared<FrameFeatures>(*liar.features);
  for (float& depth_m : features->depth_m) depth_m *= 0.5F;
  for (float& disparity_px : features->disparity_px) disparity_px *= 2.0F;
  liar.features = features;
  Map& map = views.mapped.map;
  const KeyFrameId id = scene::add_keyframe(map, liar);
  for (std::size_t p = kUnlinked; p < 200; ++p) {
    if (liar.keypoint_of[p] >= 0 && views.mapped.points[p].valid()) {
      map.add_observation(views.mapped.points[p], {id, liar.keypoint_of[p]});
    }
  }
  map.update_covisibility(id);
  ASSERT_FALSE(map.best_covisible(id, 5).empty());
  EXPECT_TRUE(create_points(kRig, map, id).empty());
}

TEST(PointCreation, UnknownKeyFrameMakesNothing) {
  Map map(kRig.pyramid);
  EXPECT_TRUE(create_points(kRig, map, KeyFrameId{}).empty());
}

}  // namespace
}  // namespace cpslam
