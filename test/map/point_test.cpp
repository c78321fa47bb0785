// Points of the Map: observations, merging, and what refresh_point computes of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/map_builder.h"

namespace cpslam {
namespace {

using test::add_keyframe;
using test::blank_features;

class PointTest : public testing::Test {
 protected:
  Map map{synthetic::pyramid()};
  KeyFrameId a = add_keyframe(map, blank_features(10));
  KeyFrameId b = add_keyframe(map, blank_features(10));
  KeyFrameId no_depth = add_keyframe(map, blank_features(10, false));
  KeyFrameId no_depth_either = add_keyframe(map, blank_features(10, false));
  const Eigen::Vector3d here{0.0, 0.0, 2.0};
};

TEST_F(PointTest, AddPointLinksBothWays) {
  const MapPointId point = map.add_point(here, {a, 3});
  ASSERT_TRUE(point.valid());
  EXPECT_EQ(map.keyframe(a)->points[3], point);
  EXPECT_EQ(map.keypoint_of(point, a), 3);
  EXPECT_EQ(map.keypoint_of(point, b), -1);
  EXPECT_EQ(map.point(point)->reference, a);
  EXPECT_EQ(map.point(point)->first_sequence, 0U);
  EXPECT_EQ(map.point(point)->descriptor, map.keyframe(a)->features->descriptors[3]);
  EXPECT_EQ(map.n_points(), 1U);
  EXPECT_EQ(map.points_created(), 1U);
}

TEST_F(PointTest, AddPointOnATakenKeypointOrWithoutKeyFrameDoesNothing) {
  const MapPointId point = map.add_point(here, {a, 3});
  EXPECT_FALSE(map.add_point(here, {a, 3}).valid());
  EXPECT_FALSE(map.add_point(here, {KeyFrameId{}, 3}).valid());
  EXPECT_EQ(map.keyframe(a)->points[3], point);
  EXPECT_EQ(map.n_points(), 1U);
  EXPECT_EQ(map.points_created(), 1U);
}

TEST_F(PointTest, AddObservationRefusesWhatWouldBreakTheLinks) {
  const MapPointId point = map.add_point(here, {a, 3});
  const MapPointId other = map.add_point(here, {b, 4});
  EXPECT_FALSE(map.add_observation(point, {a, 5})) << "the keyframe sees it already";
  EXPECT_FALSE(map.add_observation(point, {b, 4})) << "the keypoint is taken";
  EXPECT_FALSE(map.add_observation(MapPointId{}, {b, 5}));
  EXPECT_FALSE(map.add_observation(point, {KeyFrameId{}, 5}));
  EXPECT_TRUE(map.add_observation(point, {b, 5}));
  EXPECT_EQ(map.point(point)->observations.size(), 2U);
  EXPECT_EQ(map.point(other)->observations.size(), 1U);
  EXPECT_FALSE(map.keyframe(a)->points[5].valid());
}

TEST_F(PointTest, OneObservationWithDepthIsEnough) {
  const MapPointId point = map.add_point(here, {a, 3});
  map.add_observation(point, {no_depth, 1});
  map.erase_observation(point, no_depth);
  ASSERT_NE(map.point(point), nullptr);
  EXPECT_FALSE(map.keyframe(no_depth)->points[1].valid());
  map.erase_observation(point, a);
  EXPECT_EQ(map.point(point), nullptr);
  EXPECT_FALSE(map.keyframe(a)->points[3].valid());
}

TEST_F(PointTest, OneObservationWithoutDepthIsNot) {
  const MapPointId point = map.add_point(here, {a, 3});
  map.add_observation(point, {no_depth, 1});
  map.erase_observation(point, a);
  EXPECT_EQ(map.point(point), nullptr);
  EXPECT_FALSE(map.keyframe(no_depth)->points[1].valid());
  EXPECT_EQ(map.n_points(), 0U);
}

TEST_F(PointTest, TwoObservationsWithoutDepthAreEnough) {
  const MapPointId point = map.add_point(here, {a, 3});
  map.add_observation(point, {no_depth, 1});
  map.add_observation(point, {no_depth_either, 2});
  map.erase_observation(point, a);
  ASSERT_NE(map.point(point), nullptr);
  EXPECT_EQ(map.point(point)->reference, no_depth) << "the reference was erased: the next one takes over";
  map.erase_observation(point, a);
  EXPECT_NE(map.point(point), nullptr) << "an observation that is gone is not erased again";
}

TEST_F(PointTest, MergeMovesObservationsWhereThereIsRoom) {
  const MapPointId kept = map.add_point(here, {a, 1});
  map.add_observation(kept, {b, 1});
  const MapPointId old = map.add_point(here, {b, 2});
  map.add_observation(old, {no_depth, 2});
  map.count_visible(kept, true);
  map.count_visible(old, false);
  map.merge_points(old, kept);
  EXPECT_EQ(map.point(old), nullptr);
  EXPECT_EQ(map.keypoint_of(kept, a), 1);
  EXPECT_EQ(map.keypoint_of(kept, b), 1) << "kept's own observation stays";
  EXPECT_FALSE(map.keyframe(b)->points[2].valid());
  EXPECT_EQ(map.keypoint_of(kept, no_depth), 2);
  EXPECT_EQ(map.point(kept)->visible, 2 + 2);
  EXPECT_EQ(map.point(kept)->found, 2 + 1);
}

TEST_F(PointTest, MergeWithItselfOrWithNothingDoesNothing) {
  const MapPointId point = map.add_point(here, {a, 1});
  map.merge_points(point, point);
  map.merge_points(MapPointId{}, point);
  map.merge_points(point, MapPointId{});
  ASSERT_NE(map.point(point), nullptr);
  EXPECT_EQ(map.keypoint_of(point, a), 1);
  EXPECT_EQ(map.point(point)->visible, 1);
}

TEST_F(PointTest, CountsPointsByTheirObservations) {
  map.add_point(here, {a, 1});
  const MapPointId twice = map.add_point(here, {a, 2});
  map.add_observation(twice, {b, 2});
  EXPECT_EQ(map.count_points(a, 1), 2);
  EXPECT_EQ(map.count_points(a, 2), 1);
  EXPECT_EQ(map.count_points(a, 3), 0);
  EXPECT_EQ(map.count_points(KeyFrameId{}, 1), 0);
}

TEST(RefreshPoint, DescriptorIsTheMedoid) {
  Random random(5);
  const Descriptor centre = synthetic::random_descriptor(random);
  Map map(synthetic::pyramid());
  // Three at 10 bits from the centre in different bits, 20 from each other, the centre, and an outlier.
  const std::vector<Descriptor> looks{synthetic::flipped(centre, 10, 0), synthetic::random_descriptor(random),
                                      synthetic::flipped(centre, 10, 50), centre,
                                      synthetic::flipped(centre, 10, 100)};
  MapPointId point;
  for (const Descriptor& look : looks) {
    const std::vector<synthetic::Spot> spot{{.x = 320.0, .y = 240.0, .descriptor = look, .depth_m = 2.0}};
    const KeyFrameId id = add_keyframe(map, synthetic::make_features(spot));
    if (point.valid()) {
      map.add_observation(point, {id, 0});
    } else {
      point = map.add_point({0.0, 0.0, 2.0}, {id, 0});
    }
  }
  EXPECT_EQ(map.point(point)->descriptor, looks[0]);
  map.refresh_point(point);
  EXPECT_EQ(map.point(point)->descriptor, centre);
}

TEST(RefreshPoint, NormalIsTheMeanDirection) {
  Map map(synthetic::pyramid());
  const auto at = [&](const Eigen::Vector3d& centre) {
    return add_keyframe(map, blank_features(1), SE3(Eigen::Matrix3d::Identity(), -centre));
  };
  const MapPointId point = map.add_point({0.0, 0.0, 0.0}, {at({0.0, 0.0, -3.0}), 0});
  EXPECT_TRUE(map.point(point)->normal.isApprox(Eigen::Vector3d(0.0, 0.0, 1.0)));
  map.add_observation(point, {at({-5.0, 0.0, 0.0}), 0});  // its distance must not count
  map.refresh_point(point);
  EXPECT_TRUE(map.point(point)->normal.isApprox(Eigen::Vector3d(1.0, 0.0, 1.0).normalized(), 1e-12));
}

TEST(RefreshPoint, DistanceRangeIsWhatThePyramidShowsFromTheReference) {
  Map map(synthetic::pyramid());
  const std::vector<synthetic::Spot> spot{
      {.x = 320.0, .y = 240.0, .descriptor = {}, .depth_m = 2.0, .octave = 3}};
  const KeyFrameId id = add_keyframe(map, synthetic::make_features(spot));
  const MapPointId point = map.add_point({0.0, 0.0, 2.0}, {id, 0});
  // At octave 3 from 2 m: three levels finer is 1.2^3 times farther, four coarser 1.2^4 times nearer.
  EXPECT_NEAR(map.point(point)->max_distance_m, 2.0 * std::pow(1.2, 3), 1e-5);
  EXPECT_NEAR(map.point(point)->min_distance_m, 2.0 / std::pow(1.2, 4), 1e-5);
  map.set_position(point, {0.0, 0.0, 4.0});
  map.refresh_point(point);
  EXPECT_NEAR(map.point(point)->max_distance_m, 4.0 * std::pow(1.2, 3), 1e-5);
}

TEST(RefreshGeometry, IsRefreshPointButForTheDescriptor) {
  Map map(synthetic::pyramid());
  const KeyFrameId first = add_keyframe(map, blank_features(1));
  const KeyFrameId second =
      add_keyframe(map, blank_features(2), SE3(Eigen::Matrix3d::Identity(), {-1.0, 0.0, 0.0}));
  const MapPointId point = map.add_point({0.0, 0.0, 2.0}, {first, 0});
  map.add_observation(point, {second, 1});
  map.set_position(point, {0.5, 0.2, 2.5});
  map.refresh_geometry(point);
  const MapPoint refreshed = *map.point(point);
  map.refresh_point(point);
  EXPECT_EQ(refreshed.normal, map.point(point)->normal);
  EXPECT_EQ(refreshed.max_distance_m, map.point(point)->max_distance_m);
  EXPECT_EQ(refreshed.min_distance_m, map.point(point)->min_distance_m);
  EXPECT_EQ(map.point_ids(), std::vector{point});
}

}  // namespace
}  // namespace cpslam
