#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "match/orb_matcher.h"
#include "support/synthetic.h"

namespace cpslam {
namespace {

using synthetic::flipped;
using synthetic::make_features;
using synthetic::Spot;
using testing::ElementsAre;

class MatchByProjection : public testing::Test {
 protected:
  /// A query at (100, 100) for `look`.
  ProjectionQuery query_at_100(const Descriptor& descriptor) const {
    ProjectionQuery query;
    query.uv = {100.0F, 100.0F};
    query.radius = 10.0F;
    query.max_octave = 7;
    query.descriptor = &descriptor;
    return query;
  }
  std::vector<int> match(const std::vector<Spot>& spots, const std::vector<ProjectionQuery>& queries,
                         const MatchOptions& options = {},
                         const std::vector<std::uint8_t>& taken = {}) const {
    return match_by_projection(*make_features(spots), queries, taken, options);
  }
  Random random{1};
  const Descriptor look = synthetic::random_descriptor(random);
  const Descriptor other_look = synthetic::random_descriptor(random);
};

TEST_F(MatchByProjection, TakesTheMostAlikeInTheWindow) {
  const std::vector<Spot> spots{{.x = 101.0, .y = 101.0, .descriptor = flipped(look, 30)},
                                {.x = 109.0, .y = 91.0, .descriptor = flipped(look, 10)},
                                {.x = 111.0, .y = 100.0, .descriptor = look}};  // outside
  EXPECT_THAT(match(spots, {query_at_100(look)}), ElementsAre(1));
}

TEST_F(MatchByProjection, RefusesWhatLooksTooDifferent) {
  MatchOptions options;
  options.max_distance = 50;
  EXPECT_THAT(
      match({{.x = 100.0, .y = 100.0, .descriptor = flipped(look, 50)}}, {query_at_100(look)}, options),
      ElementsAre(0));
  EXPECT_THAT(
      match({{.x = 100.0, .y = 100.0, .descriptor = flipped(look, 51)}}, {query_at_100(look)}, options),
      ElementsAre(-1));
}

TEST_F(MatchByProjection, RefusesOtherOctaves) {
  ProjectionQuery query = query_at_100(look);
  query.min_octave = 2;
  query.max_octave = 3;
  for (int octave = 0; octave < 8; ++octave) {
    const int expected = octave == 2 || octave == 3 ? 0 : -1;
    EXPECT_THAT(match({{.x = 100.0, .y = 100.0, .descriptor = look, .octave = octave}}, {query}),
                ElementsAre(expected))
        << octave;
  }
}

TEST_F(MatchByProjection, LeavesTakenKeypointsAlone) {
  const std::vector<Spot> spots{{.x = 100.0, .y = 100.0, .descriptor = look},
                                {.x = 102.0, .y = 100.0, .descriptor = flipped(look, 20)}};
  EXPECT_THAT(match(spots, {query_at_100(look)}, {}, {1, 0}), ElementsAre(1));
  EXPECT_THAT(match(spots, {query_at_100(look)}, {}, {1, 1}), ElementsAre(-1));
}

TEST_F(MatchByProjection, RatioCountsOnlyWithinAnOctave) {
  MatchOptions options;
  options.ratio = 0.8F;
  std::vector<Spot> spots{{.x = 100.0, .y = 100.0, .descriptor = flipped(look, 20)},
                          {.x = 102.0, .y = 100.0, .descriptor = flipped(look, 24)}};
  EXPECT_THAT(match(spots, {query_at_100(look)}, options), ElementsAre(-1)) << "20 > 0.8 * 24";
  spots[1].octave = 1;
  EXPECT_THAT(match(spots, {query_at_100(look)}, options), ElementsAre(0));
  spots[1].octave = 0;
  spots[1].descriptor = flipped(look, 25);
  EXPECT_THAT(match(spots, {query_at_100(look)}, options), ElementsAre(0)) << "20 = 0.8 * 25";
}

TEST_F(MatchByProjection, OneKeypointGoesToTheMostAlikeQuery) {
  const std::vector<Spot> spots{{.x = 100.0, .y = 100.0, .descriptor = look}};
  const Descriptor near_look = flipped(look, 5);
  const Descriptor far_look = flipped(look, 9);
  EXPECT_THAT(match(spots, {query_at_100(far_look), query_at_100(near_look)}), ElementsAre(-1, 0));
  EXPECT_THAT(match(spots, {query_at_100(near_look), query_at_100(far_look)}), ElementsAre(0, -1));
  const Descriptor as_near = flipped(look, 5, 100);
  EXPECT_THAT(match(spots, {query_at_100(near_look), query_at_100(as_near)}), ElementsAre(0, -1))
      << "the first of equals";
}

TEST_F(MatchByProjection, DisparityMustFit) {
  ProjectionQuery query = query_at_100(look);
  query.disparity = 20.0F;  // 2 m with bf = 40
  query.radius = 5.0F;
  Spot spot{.x = 100.0, .y = 100.0, .descriptor = look, .depth_m = 40.0 / 24.0};
  EXPECT_THAT(match({spot}, {query}), ElementsAre(0)) << "4 px off";
  spot.depth_m = 40.0 / 26.0;
  EXPECT_THAT(match({spot}, {query}), ElementsAre(-1)) << "6 px off";
  spot.depth_m = 0.0;
  EXPECT_THAT(match({spot}, {query}), ElementsAre(0)) << "a keypoint without depth cannot contradict";
  spot.depth_m = 40.0 / 26.0;
  query.disparity = 0.0F;
  EXPECT_THAT(match({spot}, {query}), ElementsAre(0)) << "nor can a query without";
}

TEST_F(MatchByProjection, RotationOfTheMinorityIsDropped) {
  std::vector<Spot> spots;
  std::vector<Descriptor> looks;
  for (int i = 0; i < 41; ++i) looks.push_back(synthetic::random_descriptor(random));
  std::vector<ProjectionQuery> queries;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const double x = 15.0 * static_cast<double>(i);
    const float turn = i == 20 ? 200.0F : 30.0F;
    spots.push_back({.x = x, .y = 50.0, .descriptor = looks[i], .angle_deg = 10.0F});
    queries.push_back(query_at_100(looks[i]));
    queries.back().uv = {static_cast<float>(x), 50.0F};
    queries.back().angle_deg = 10.0F + turn;
  }
  MatchOptions options;
  options.check_rotation = true;
  const std::vector<int> strict = match(spots, queries, options);
  const std::vector<int> lax = match(spots, queries);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    EXPECT_EQ(strict[i], i == 20 ? -1 : static_cast<int>(i));
    EXPECT_EQ(lax[i], static_cast<int>(i));
  }
}

TEST_F(MatchByProjection, NothingToMatch) {
  EXPECT_TRUE(match({}, {}).empty());
  EXPECT_THAT(match({}, {query_at_100(look)}), ElementsAre(-1));
  EXPECT_TRUE(match({{.x = 1.0, .y = 1.0, .descriptor = look}}, {}).empty());
}

TEST_F(MatchByProjection, FindsAWholeView) {
  const synthetic::World world = synthetic::random_world(400, random);
  const SE3 pose = synthetic::moved({}, {0.1, 0.0, 0.05}, 0.03);
  const synthetic::View view = synthetic::look(world, pose, {.noise_px = 0.5, .bit_flips = 20}, random);
  const PinholeCamera camera(synthetic::settings().camera);
  std::vector<ProjectionQuery> queries;
  for (std::size_t i = 0; i < world.points.size(); ++i) {
    const Eigen::Vector3d in_camera = pose * world.points[i];
    queries.push_back(query_at_100(world.descriptors[i]));
    queries.back().uv = camera.project(in_camera).cast<float>();
    queries.back().disparity = static_cast<float>(camera.bf() / in_camera.z());
  }
  EXPECT_EQ(match_by_projection(*view.features, queries, {}, {}), view.keypoint_of);
}

}  // namespace
}  // namespace cpslam
