#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numeric>

#include "match/orb_matcher.h"
#include "support/synthetic.h"

namespace cpslam {
namespace {

using synthetic::flipped;
using synthetic::make_features;
using synthetic::Spot;

using Pairs = std::vector<std::pair<int, int>>;

std::vector<int> all(const FrameFeatures& features) {
  std::vector<int> indices(static_cast<std::size_t>(features.size()));
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

Pairs match(const FrameFeatures& a, const FrameFeatures& b, const EpipolarGeometry& geometry,
            const MatchOptions& options = {}) {
  const std::vector<int> in_a = all(a);
  const std::vector<int> in_b = all(b);
  Pairs pairs;
  for (const KeypointMatch& m :
       match_by_epipolar_line({a, in_a}, {b, in_b}, geometry, synthetic::pyramid(), options)) {
    pairs.emplace_back(m.a, m.b);
  }
  return pairs;
}

/// Two cameras, b to the right of a: epipolar lines are the image rows.
EpipolarGeometry sideways() {
  EpipolarGeometry geometry;
  geometry.fundamental_ba << 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0;
  geometry.epipole_in_b = {1e9, 1e9};
  return geometry;
}

EpipolarGeometry geometry_of(const SE3& a_from_world, const SE3& b_from_world) {
  const PinholeCamera camera(synthetic::settings().camera);
  Eigen::Matrix3d k;
  k << camera.fx(), 0.0, camera.cx(), 0.0, camera.fy(), camera.cy(), 0.0, 0.0, 1.0;
  const SE3 b_from_a = b_from_world * a_from_world.inverse();
  EpipolarGeometry geometry;
  geometry.fundamental_ba =
      k.inverse().transpose() * skew(b_from_a.translation) * b_from_a.rotation * k.inverse();
  geometry.epipole_in_b = camera.project(b_from_a.translation);
  return geometry;
}

class MatchByEpipolarLine : public testing::Test {
 protected:
  Random random{3};
  const Descriptor look = synthetic::random_descriptor(random);
  const std::shared_ptr<FrameFeatures> a =
      make_features(std::vector<Spot>{{.x = 300.0, .y = 200.0, .descriptor = look}});
};

TEST_F(MatchByEpipolarLine, PointsOffTheLineAreRefused) {
  // 95 % of a normal error with sigma of one pixel at the keypoint's level: 1.96 px.
  const auto b_at = [&](double y, int octave) {
    return make_features(std::vector<Spot>{{.x = 100.0, .y = y, .descriptor = look, .octave = octave}});
  };
  EXPECT_EQ(match(*a, *b_at(201.9, 0), sideways()).size(), 1U);
  EXPECT_EQ(match(*a, *b_at(198.1, 0), sideways()).size(), 1U);
  EXPECT_EQ(match(*a, *b_at(202.1, 0), sideways()).size(), 0U);
  EXPECT_EQ(match(*a, *b_at(202.1, 1), sideways()).size(), 1U) << "a coarser level is less exact";
}

TEST_F(MatchByEpipolarLine, TheMostAlikeOnTheLineWins) {
  const auto b = make_features(std::vector<Spot>{{.x = 100.0, .y = 200.0, .descriptor = flipped(look, 20)},
                                                 {.x = 150.0, .y = 200.0, .descriptor = flipped(look, 10)},
                                                 {.x = 150.0, .y = 250.0, .descriptor = look}});
  EXPECT_EQ(match(*a, *b, sideways()), (Pairs{{0, 1}}));
  MatchOptions options;
  options.max_distance = 9;
  EXPECT_TRUE(match(*a, *b, sideways(), options).empty());
}

TEST_F(MatchByEpipolarLine, OneKeypointOfBGoesToTheMostAlike) {
  const auto two = make_features(std::vector<Spot>{{.x = 300.0, .y = 200.0, .descriptor = flipped(look, 9)},
                                                   {.x = 310.0, .y = 200.0, .descriptor = flipped(look, 5)},
                                                   {.x = 320.0, .y = 200.0, .descriptor = flipped(look, 7)}});
  const auto b = make_features(std::vector<Spot>{{.x = 100.0, .y = 200.0, .descriptor = look}});
  EXPECT_EQ(match(*two, *b, sideways()), (Pairs{{1, 0}}));
}

TEST_F(MatchByEpipolarLine, NearTheEpipoleDepthIsNeeded) {
  const Descriptor& d = look;
  EpipolarGeometry geometry = sideways();
  geometry.epipole_in_b = {100.0, 200.0};
  const auto b_at = [&](double x, double depth_m, int octave = 0) {
    return make_features(
        std::vector<Spot>{{.x = x, .y = 200.0, .descriptor = d, .depth_m = depth_m, .octave = octave}});
  };
  EXPECT_EQ(match(*a, *b_at(109.0, 0.0), geometry).size(), 0U);
  EXPECT_EQ(match(*a, *b_at(111.0, 0.0), geometry).size(), 1U);
  EXPECT_EQ(match(*a, *b_at(111.0, 0.0, 1), geometry).size(), 0U) << "12 px at level 1";
  EXPECT_EQ(match(*a, *b_at(109.0, 2.0), geometry).size(), 1U);
  const auto a_with_depth =
      make_features(std::vector<Spot>{{.x = 300.0, .y = 200.0, .descriptor = d, .depth_m = 2.0}});
  EXPECT_EQ(match(*a_with_depth, *b_at(109.0, 0.0), geometry).size(), 1U);
}

TEST_F(MatchByEpipolarLine, NoMotionGivesNoLines) {
  EXPECT_TRUE(match(*a, *a, EpipolarGeometry{}).empty());
}

TEST_F(MatchByEpipolarLine, FindsWhatTwoViewsShare) {
  const synthetic::World world = synthetic::random_world(300, random);
  const SE3 pose_b = synthetic::moved({}, {0.2, 0.05, 0.1}, -0.05);
  const synthetic::View view_a = synthetic::look(world, {}, {.bit_flips = 15}, random);
  const synthetic::View view_b = synthetic::look(world, pose_b, {.noise_px = 0.3, .bit_flips = 15}, random);
  MatchOptions options;
  options.max_distance = kStrictDistance;
  options.check_rotation = true;
  const Pairs pairs = match(*view_a.features, *view_b.features, geometry_of({}, pose_b), options);
  EXPECT_GT(pairs.size(), 0.95 * view_b.features->size());
  for (const auto& [in_a, in_b] : pairs) {
    EXPECT_EQ(view_a.point_of[static_cast<std::size_t>(in_a)],
              view_b.point_of[static_cast<std::size_t>(in_b)]);
  }
  // The same looks with a geometry that is wrong: nearly nothing lies on its line.
  const SE3 wrong = synthetic::moved({}, {-0.1, 0.2, 0.0}, 0.1);
  EXPECT_LT(match(*view_a.features, *view_b.features, geometry_of({}, wrong), options).size(),
            0.1 * view_b.features->size());
}

}  // namespace
}  // namespace cpslam
