#include "viewer/scene_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "viewer/sample_scene.h"

namespace cpslam::viewer {
namespace {

constexpr Colour kSome{1, 2, 3, 4};

Eigen::Vector3d position(const Vertex& vertex) {
  return {vertex.position[0], vertex.position[1], vertex.position[2]};
}

TEST(SceneShapes, PointsAreColouredByHeightWhateverIsUp) {
  const std::vector<WorldPoint> points{{0, 0, 0}, {0, -1, 0}, {0, -2, 0}};
  const auto vertices = height_coloured(points, -Eigen::Vector3d::UnitY());
  ASSERT_EQ(vertices.size(), 3U);
  EXPECT_EQ(vertices[1].position, points[1]);
  EXPECT_EQ(vertices[0].colour, height_colour(0.0));
  const auto upside_down = height_coloured(points, Eigen::Vector3d::UnitY());
  EXPECT_EQ(upside_down[2].colour, vertices[0].colour);
  EXPECT_NE(vertices[0].colour, vertices[2].colour);
  EXPECT_TRUE(height_coloured({}, Eigen::Vector3d::UnitY()).empty());
  EXPECT_EQ(height_coloured({{1, 1, 1}}, Eigen::Vector3d::UnitY()).size(), 1U) << "no height at all";
}

TEST(SceneShapes, ThinningKeepsNoMoreThanAskedForEvenly) {
  std::vector<WorldPoint> points;
  for (int i = 0; i < 1000; ++i) points.push_back({static_cast<float>(i), 0.0F, 0.0F});
  EXPECT_EQ(thinned(points, 1000).size(), 1000U);
  const auto some = thinned(points, 999);
  EXPECT_EQ(some.size(), 500U);
  EXPECT_EQ(some[499][0], 998.0F);
  EXPECT_EQ(thinned(points, 1).size(), 1U);
  EXPECT_TRUE(thinned({}, 10).empty());
}

TEST(SceneShapes, AFrustumIsWhatTheCameraSees) {
  const CameraSettings camera = sample::camera();
  const auto lines = frustum(SE3(), camera, 2.0, kSome);
  ASSERT_EQ(lines.size(), 8U) << "four rays, four rims";
  double left = 0.0;
  double top = 0.0;
  for (const Segment& line : lines) {
    EXPECT_EQ(line.from.colour, kSome);
    for (const Vertex& end : {line.from, line.to}) {
      const double z = position(end).z();
      EXPECT_TRUE(std::abs(z) < 1e-6 || std::abs(z - 2.0) < 1e-6);
      left = std::min(left, position(end).x());
      top = std::min(top, position(end).y());
    }
  }
  EXPECT_NEAR(left, -2.0 * camera.cx / camera.fx, 1e-5);
  EXPECT_NEAR(top, -2.0 * camera.cy / camera.fy, 1e-5);
}

TEST(SceneShapes, FrustaStandAtTheirPoses) {
  Trajectory poses{{0.0, {}}, {1.0, {}}};
  poses[1].world_from_camera.translation_m = {5.0, 6.0, 7.0};
  const auto lines = frusta(poses, sample::camera(), 0.1, kSome);
  ASSERT_EQ(lines.size(), 16U);
  EXPECT_LT((position(lines[8].from) - Eigen::Vector3d(5.0, 6.0, 7.0)).norm(), 1e-6);
}

TEST(SceneShapes, TheGridLiesOnTheFloorAndFadesOut) {
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, -1.0, 0.2).normalized();
  const Extent extent{{1.0, 0.0, 2.0}, 3.0, -1.4};
  const auto lines = floor_grid(extent, up, {200, 200, 200, 100});
  ASSERT_FALSE(lines.empty());
  for (const Segment& line : lines) {
    EXPECT_NEAR(up.dot(position(line.from)), -1.4, 1e-5);
    EXPECT_NEAR((position(line.to) - position(line.from)).norm(), 1.0, 1e-5);
    const double off_m = (position(line.from) - extent.centre).norm();
    if (off_m > 6.0) {
      EXPECT_EQ(line.from.colour.alpha, 0);
    } else if (off_m < 2.0) {
      EXPECT_GT(line.from.colour.alpha, 20);
    }
  }
  const Extent huge{{0.0, 0.0, 0.0}, 1e6, 0.0};
  EXPECT_LT(floor_grid(huge, up, kSome).size(), 100000U);
}

TEST(SceneShapes, AnArrowShowsWhereSomebodyGoes) {
  const Eigen::Vector3d up(0.0, -1.0, 0.0);
  PersonShape person = sample::person(1, {0.0, 1.4, 0.0});
  const auto arrow = motion_arrow(person, up, kSome);
  ASSERT_EQ(arrow.size(), 3U);
  const Eigen::Vector3d way = position(arrow[0].to) - position(arrow[0].from);
  EXPECT_GT(way.x(), 0.3);
  EXPECT_NEAR(way.normalized().x(), 1.0, 1e-5) << "along his velocity";
  EXPECT_EQ(arrow[1].from.position, arrow[0].to.position);
  person.velocity_m_per_s = {0.01F, 0.0F, 0.0F};
  EXPECT_TRUE(motion_arrow(person, up, kSome).empty()) << "he stands";
  EXPECT_TRUE(motion_arrow({}, up, kSome).empty());
}

TEST(SceneShapes, EdgesJoinTheirKeyframes) {
  const MapSnapshot map = sample::map(1, 4);
  const auto lines = edge_lines({{3, 1}}, map.keyframes, kSome);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].from.position[0], map.keyframes[3].world_from_camera.translation_m[0], 1e-6);
  EXPECT_NEAR(lines[0].to.position[0], map.keyframes[1].world_from_camera.translation_m[0], 1e-6);
}

/// Positions on a line at these times.
Trajectory along_x(const std::vector<std::pair<double, double>>& times_and_x) {
  Trajectory trajectory;
  for (const auto& [time_s, x] : times_and_x) {
    trajectory.push_back({time_s, {}});
    trajectory.back().world_from_camera.translation_m[0] = x;
  }
  return trajectory;
}

TEST(SceneShapes, APathHasGapsWhereTheCameraWasLost) {
  const auto lines = path(along_x({{0.0, 0.0}, {0.1, 0.1}, {0.2, 0.2}, {5.0, 1.0}, {5.1, 1.1}}), kSome);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1].to.position[0], 0.2F);
  EXPECT_EQ(lines[2].from.position[0], 1.0F);
  EXPECT_TRUE(path({}, kSome).empty());
  EXPECT_TRUE(path(along_x({{0.0, 0.0}}), kSome).empty());
}

TEST(SceneShapes, APathOfTinyStepsIsDrawnInFewAndToItsEnds) {
  std::vector<std::pair<double, double>> tiny;
  for (int i = 0; i <= 1000; ++i) tiny.emplace_back(0.01 * i, 0.0001 * i);
  tiny.emplace_back(20.0, 3.0);
  tiny.emplace_back(20.1, 3.001);
  const auto lines = path(along_x(tiny), kSome);
  ASSERT_GE(lines.size(), 10U);
  ASSERT_LE(lines.size(), 12U);
  EXPECT_EQ(lines.front().from.position[0], 0.0F);
  EXPECT_FLOAT_EQ(lines[lines.size() - 2].to.position[0], 0.1F) << "up to the gap";
  EXPECT_FLOAT_EQ(lines.back().to.position[0], 3.001F);
  for (std::size_t i = 1; i + 1 < lines.size(); ++i)
    EXPECT_EQ(lines[i].from.position, lines[i - 1].to.position);
}

TEST(SceneShapes, TheTruthComesIntoTheEstimatesWorld) {
  const Trajectory estimate = sample::map(1, 10).trajectory;
  // Another world, and longer at both ends.
  const SE3 truth_from_estimate(so3_exp({0.3, -0.2, 1.0}), {10.0, 20.0, 30.0});
  Trajectory truth;
  for (const StampedPose& pose : estimate)
    truth.push_back({pose.time_s, to_pose(truth_from_estimate * from_pose(pose.world_from_camera))});
  truth.insert(truth.begin(), {-5.0, {}});
  truth.push_back({1000.0, {}});
  const Trajectory aligned = aligned_truth(truth, estimate);
  ASSERT_EQ(aligned.size(), estimate.size());
  for (std::size_t i = 0; i < aligned.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(aligned[i].world_from_camera.translation_m[axis],
                  estimate[i].world_from_camera.translation_m[axis], 1e-6);
    }
  }
}

TEST(SceneShapes, TooLittleIsNotAligned) {
  const Trajectory estimate = sample::map(1, 1).trajectory;
  EXPECT_TRUE(aligned_truth(estimate, estimate).empty());
  EXPECT_TRUE(aligned_truth({}, sample::map(1, 10).trajectory).empty());
}

}  // namespace
}  // namespace cpslam::viewer
