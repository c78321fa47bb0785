// A map taken apart and put together again is the same map.
#include "map/map_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "io/error_text.h"
#include "map/same_parts.h"
#include "map/some_map.h"

namespace cpslam {
namespace {

using testing::HasSubstr;

constexpr int kLevels = 8;
const double kNan = std::numeric_limits<double>::quiet_NaN();

/// Points that each keyframe shares with each other one, counted point by point.
std::map<KeyFrameId, std::map<KeyFrameId, int>> count_shared_points(const Map& map) {
  std::map<KeyFrameId, std::map<KeyFrameId, int>> shared;
  for (const MapPointId id : map.point_ids()) {
    for (const Observation& a : map.point(id)->observations) {
      for (const Observation& b : map.point(id)->observations) {
        if (a.keyframe != b.keyframe) ++shared[a.keyframe][b.keyframe];
      }
    }
  }
  return shared;
}

bool is_best(const std::map<KeyFrameId, int>& shared, KeyFrameId id) {
  const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto best = std::max_element(shared.begin(), shared.end(), fewer);
  return best != shared.end() && best->first == id;
}

/// An edge to all that share 15 points, and to the best in any case; with the right number, both ways.
void check_edges(const Map& map) {
  auto shared = count_shared_points(map);
  for (const KeyFrameId a : map.keyframes_by_sequence()) {
    for (const KeyFrameId b : map.keyframes_by_sequence()) {
      const int n = shared[a][b];
      const bool edge = n >= 15 || (n > 0 && (is_best(shared[a], b) || is_best(shared[b], a)));
      EXPECT_EQ(test::shared_points_of_edge(map, a, b), edge ? n : 0);
    }
  }
}

TEST(MapParts, RandomMapsComeBackAsTheyWere) {
  for (std::uint64_t seed = 20; seed < 26; ++seed) {
    SCOPED_TRACE(seed);
    const bool lonely = seed % 2 == 1;
    MapParts parts = test::some_parts(seed, 1500, lonely);
    ASSERT_NO_THROW(check(parts, kLevels));
    EXPECT_GT(parts.keyframes.size(), 5U);
    EXPECT_GT(parts.points.size(), 50U);
    EXPECT_GT(parts.loops.size(), 1U);
    Map map(synthetic::pyramid());
    const std::vector<KeyFrameId> ids = map.assemble(parts);
    EXPECT_EQ(ids, map.keyframes_by_sequence());
    test::check_links(map);
    test::check_covisibility(map);
    check_edges(map);
    test::check_tree(map, ids.front(), !lonely);
    parts.frames.clear();  // which a Map does not know
    test::expect_same(take_apart(map), parts);
  }
}

TEST(MapParts, WhatFollowsFromThePartsIsWorkedOut) {
  Map map(synthetic::pyramid());
  const KeyFrameId a = test::add_keyframe(map, test::blank_features(30));
  const KeyFrameId b =
      test::add_keyframe(map, test::blank_features(31), SE3(so3_exp({0, 0.1, 0}), {0.5, 0, 0}));
  const auto points = test::share_points(map, a, b, 20);
  map.update_covisibility(a);
  map.update_covisibility(b);
  map.add_loop_edge(a, b);
  for (const MapPointId id : points) map.refresh_point(id);
  map.count_visible(points[3], false);
  Map again(synthetic::pyramid());
  const std::vector<KeyFrameId> ids = again.assemble(take_apart(map));
  EXPECT_EQ(again.keyframe(ids[0])->children, std::vector{ids[1]});
  EXPECT_EQ(again.keyframe(ids[0])->loops, std::vector{ids[1]});
  EXPECT_EQ(again.keyframe(ids[1])->loops, std::vector{ids[0]});
  EXPECT_EQ(test::shared_points_of_edge(again, ids[0], ids[1]), 20);
  const std::vector<MapPointId> new_points = again.point_ids();
  ASSERT_EQ(new_points.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const MapPoint& before = *map.point(points[i]);
    const MapPoint& after = *again.point(new_points[i]);
    EXPECT_EQ(after.normal, before.normal);
    EXPECT_EQ(after.descriptor, before.descriptor);
    EXPECT_EQ(after.min_distance_m, before.min_distance_m);
    EXPECT_EQ(after.max_distance_m, before.max_distance_m);
    EXPECT_EQ(after.visible, before.visible);
  }
  EXPECT_EQ(again.keyframes_created(), 2U) << "the next keyframe gets a sequence of its own";
  EXPECT_FALSE(again.erase_keyframe(ids[0])) << "it is the root and the end of a loop";
}

TEST(MapParts, CulledKeyframesLeaveNoGap) {
  Map map(synthetic::pyramid());
  const KeyFrameId a = test::add_keyframe(map, test::blank_features(60));
  const KeyFrameId b = test::add_keyframe(map, test::blank_features(61));
  const KeyFrameId c = test::add_keyframe(map, test::blank_features(62));
  test::share_points(map, a, b, 20);
  test::share_points(map, b, c, 20);
  for (const KeyFrameId id : {a, b, c}) map.update_covisibility(id);
  ASSERT_TRUE(map.erase_keyframe(b));
  const MapParts parts = take_apart(map);
  ASSERT_EQ(parts.keyframes.size(), 2U);
  EXPECT_EQ(parts.keyframes[1].sequence, 2U);
  EXPECT_EQ(parts.keyframes[1].parent, 0U);
  EXPECT_NO_THROW(check(parts, kLevels));
}

/// One thing wrong, and a word of what is said about it.
struct Damage {
  const char* word;
  std::function<void(MapParts&)> damage;
};

void with_features(MapParts& parts, const std::function<void(FrameFeatures&)>& change) {
  auto features = std::make_shared<FrameFeatures>(*parts.keyframes[1].features);
  change(*features);
  parts.keyframes[1].features = features;
}

TEST(MapPartsCheck, NamesWhatIsWrong) {
  const std::vector<Damage> damages{
      {"no keyframes", [](MapParts& p) { p.keyframes.clear(); }},
      {"comes before", [](MapParts& p) { p.keyframes[2].sequence = p.keyframes[1].sequence; }},
      {"never made", [](MapParts& p) { p.keyframes_created = p.keyframes.back().sequence; }},
      {"seen too much", [](MapParts& p) { p.keyframes_created = ~std::uint64_t{0}; }},
      {"no time", [](MapParts& p) { p.keyframes[1].time_s = kNan; }},
      {"keyframe 1 has a pose", [](MapParts& p) { p.keyframes[1].cam_from_world.translation.x() = kNan; }},
      {"has a pose", [](MapParts& p) { p.keyframes[1].cam_from_world.translation.x() = 1e300; }},
      {"has a pose", [](MapParts& p) { p.keyframes[1].cam_from_world.rotation *= -1.0; }},
      {"has a pose", [](MapParts& p) { p.keyframes[1].cam_from_world.rotation *= 1.01; }},
      {"has a pose", [](MapParts& p) { p.keyframes[1].cam_from_world.rotation(0, 0) = kNan; }},
      {"parent that is not there", [](MapParts& p) { p.keyframes[1].parent = 1000; }},
      {"is the root", [](MapParts& p) { p.keyframes[0].parent = 1; }},
      {"its own ancestor", [](MapParts& p) { p.keyframes[1].parent = 1; }},
      {"its own ancestor",
       [](MapParts& p) {
         p.keyframes[1].parent = 2;
         p.keyframes[2].parent = 3;
         p.keyframes[3].parent = 1;
       }},
      {"feature", [](MapParts& p) { with_features(p, [](auto& f) { f.keypoints[0].x = NAN; }); }},
      {"feature", [](MapParts& p) { with_features(p, [](auto& f) { f.keypoints[9].y = 1e9F; }); }},
      {"feature", [](MapParts& p) { with_features(p, [](auto& f) { f.keypoints[9].octave = kLevels; }); }},
      {"feature", [](MapParts& p) { with_features(p, [](auto& f) { f.keypoints[9].octave = -1; }); }},
      {"feature", [](MapParts& p) { with_features(p, [](auto& f) { f.keypoints[9].angle_deg = -1.0F; }); }},
      {"feature", [](MapParts& p) { with_features(p, [](auto& f) { f.depth_m[9] = -1.0F; }); }},
      {"feature", [](MapParts& p) { with_features(p, [](auto& f) { f.depth_sigma_m[9] = NAN; }); }},
      {"joins nothing",
       [](MapParts& p) {
         p.loops[0] = {1, 1};
       }},
      {"joins nothing",
       [](MapParts& p) {
         p.loops[0] = {1, 1000};
       }},
      {"point 2 has a position", [](MapParts& p) { p.points[2].position_in_world.z() = kNan; }},
      {"seen by nobody", [](MapParts& p) { p.points[2].observations.clear(); }},
      {"what is not there", [](MapParts& p) { p.points[2].observations[0].keyframe = 1000; }},
      {"what is not there", [](MapParts& p) { p.points[2].observations[0].keypoint = MapParts::kNone; }},
      {"twice by one",
       [](MapParts& p) {
         const MapParts::ObservationPart seen = p.points[2].observations[0];
         p.points[2].observations.push_back({seen.keyframe, (seen.keypoint + 1) % 60});
       }},
      {"sees another", [](MapParts& p) { p.points[3] = p.points[2]; }},
      {"reference", [](MapParts& p) { p.points[2].reference = MapParts::kNone; }},
      {"never was", [](MapParts& p) { p.points[2].first_sequence = p.keyframes_created; }},
      {"too often", [](MapParts& p) { p.points[2].visible = ~0U; }},
      {"frame 0 has no time", [](MapParts& p) { p.frames[0].time_s = kNan; }},
      {"hangs on", [](MapParts& p) { p.frames[1].keyframe = MapParts::kNone; }},
      {"frame 1 has a pose", [](MapParts& p) { p.frames[1].cam_from_keyframe.rotation.setZero(); }},
  };
  const MapParts sound = test::some_parts(31, 400);
  ASSERT_GT(sound.keyframes.size(), 3U);
  ASSERT_NO_THROW(check(sound, kLevels));
  for (const auto& [word, damage] : damages) {
    MapParts parts = sound;
    damage(parts);
    EXPECT_THAT(input_error([&] { check(parts, kLevels); }), HasSubstr(word));
  }
}

}  // namespace
}  // namespace cpslam
