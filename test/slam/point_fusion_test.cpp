#include "slam/point_fusion.h"

#include <gtest/gtest.h>

#include <set>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

constexpr std::size_t kPoints = 200;
constexpr std::size_t kApart = 60;

class PointFusion : public testing::Test {
 protected:
  PointFusion() : mapped(kPoints, {SE3(), synthetic::moved({}, {0.1, 0.0, 0.0})}, {}, random) {
    id = mapped.add_view(synthetic::moved({}, {0.15, 0.0, 0.0}), {}, random, kApart);
  }
  [[nodiscard]] MapPointId seen_by(std::size_t view, std::size_t p) const {
    const int keypoint = mapped.views[view].keypoint_of[p];
    return keypoint < 0
               ? MapPointId{}
               : mapped.map.keyframe(mapped.keyframes[view])->points[static_cast<std::size_t>(keypoint)];
  }
  /// Points that all three views have in their image.
  [[nodiscard]] bool in_all(std::size_t p) const {
    return std::all_of(mapped.views.begin(), mapped.views.end(),
                       [&](const auto& v) { return v.keypoint_of[p] >= 0; });
  }
  void expect_one_point_each() const {
    std::size_t checked = 0;
    for (std::size_t p = 0; p < kApart; ++p) {
      if (!in_all(p)) continue;
      ++checked;
      EXPECT_TRUE(seen_by(2, p).valid()) << p;
      EXPECT_EQ(seen_by(2, p), seen_by(0, p)) << p;
      EXPECT_EQ(seen_by(2, p), seen_by(1, p)) << p;
    }
    EXPECT_GT(checked, 30U);
  }
  Random random{21};
  scene::MappedWorld mapped;
  KeyFrameId id;
};

TEST_F(PointFusion, KeyFrameGainsTheNeighboursPoints) {
  const std::size_t points = mapped.map.n_points();
  fuse_points(kRig, mapped.map, id);
  expect_one_point_each();
  EXPECT_EQ(mapped.map.n_points(), points);
}

TEST_F(PointFusion, DuplicatesBecomeOne) {
  // The new keyframe made points of its own for what the others know, one centimetre off.
  for (std::size_t p = 0; p < kApart; ++p) {
    if (const int keypoint = mapped.views[2].keypoint_of[p]; keypoint >= 0) {
      mapped.map.add_point(mapped.world.points[p] + Eigen::Vector3d(0.0, 0.0, 0.01), {id, keypoint});
    }
  }
  const std::size_t points = mapped.map.n_points();
  ASSERT_NE(seen_by(2, 0), seen_by(0, 0));
  fuse_points(kRig, mapped.map, id);
  expect_one_point_each();
  EXPECT_LT(mapped.map.n_points(), points - 30);
}

TEST_F(PointFusion, NeighboursGainTheKeyFramesPoints) {
  // Only the new keyframe knows them.
  for (std::size_t p = 0; p < kApart; ++p) {
    mapped.map.erase_point(mapped.points[p]);
    if (const int keypoint = mapped.views[2].keypoint_of[p]; keypoint >= 0) {
      mapped.map.add_point(mapped.world.points[p], {id, keypoint});
    }
  }
  fuse_points(kRig, mapped.map, id);
  expect_one_point_each();
}

TEST_F(PointFusion, RecountsCovisibility) {
  const auto shared = [&] {
    for (const Covisible& edge : mapped.map.keyframe(id)->covisible) {
      if (edge.keyframe == mapped.keyframes[1]) return edge.shared_points;
    }
    return 0;
  };
  const int before = shared();
  fuse_points(kRig, mapped.map, id);
  EXPECT_GT(before, 0);
  EXPECT_GT(shared(), before + 30);
}

TEST_F(PointFusion, DifferentLooksStayApart) {
  std::vector<MapPointId> strangers;
  Map& map = mapped.map;
  // The same places, other looks.
  synthetic::World other = mapped.world;
  for (Descriptor& look : other.descriptors) look = synthetic::random_descriptor(random);
  const synthetic::View view = synthetic::look(other, mapped.views[2].cam_from_world, {}, random);
  const KeyFrameId stranger = scene::add_keyframe(map, view);
  for (std::size_t p = 0; p < kPoints; ++p) {
    const int keypoint = view.keypoint_of[p];
    if (keypoint < 0) continue;
    if (p < 100) {
      map.add_observation(mapped.points[p], {stranger, keypoint});
    } else {
      strangers.push_back(map.add_point(other.points[p], {stranger, keypoint}));
    }
  }
  map.update_covisibility(stranger);
  fuse_points(kRig, map, stranger);
  for (const MapPointId point : strangers) {
    ASSERT_NE(map.point(point), nullptr);
    EXPECT_EQ(map.point(point)->observations.size(), 1U);
  }
}

TEST(PointFusionAlone, UnknownKeyFrameIsNoTrouble) {
  Map map(kRig.pyramid);
  fuse_points(kRig, map, KeyFrameId{});
  EXPECT_EQ(map.n_points(), 0U);
}

}  // namespace
}  // namespace cpslam
