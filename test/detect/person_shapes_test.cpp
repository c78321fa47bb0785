#include "detect/person_shapes.h"

#include <gtest/gtest.h>

#include "detect/depth_scene.h"

namespace cpslam {
namespace {

using scene::DepthScene;
using scene::View;

class PersonShapesTest : public testing::Test {
 protected:
  PersonShapesTest() {
    const DepthScene room = DepthScene().wall(4.5F).person({3, {-0.2F, scene::kCameraHeightM, 2.0F}});
    track = scene::track_of(room.look(camera), 3);
    track.velocity_m_per_s = {0.5F, 0.0F, -1.0F};
  }
  GridCamera camera = scene::grid_camera();
  PersonTrack track;
};

TEST_F(PersonShapesTest, APointForEachCellWhereItsDepthSays) {
  const auto shapes = person_shapes(camera, {track}, SE3());
  ASSERT_EQ(shapes.size(), 1U);
  EXPECT_EQ(shapes[0].number, 3);
  EXPECT_FALSE(shapes[0].hidden);
  ASSERT_EQ(shapes[0].surface.size(), track.visible.size());
  for (std::size_t i = 0; i < track.visible.size(); ++i) {
    const Eigen::Vector3f expected = camera.point(track.visible.cells[i], track.visible.depth_m[i]);
    EXPECT_EQ(shapes[0].surface[i], (WorldPoint{expected.x(), expected.y(), expected.z()}));
  }
  EXPECT_NEAR(shapes[0].spacing_m, 2.0 * kDepthCellPx / camera.camera().fx(), 0.002);
}

TEST_F(PersonShapesTest, GoIntoTheWorldWithTheirVelocity) {
  // The camera looks along the world's x.
  Eigen::Matrix3d rotation;
  rotation << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const SE3 world_from_camera(rotation, {10.0, 20.0, 1.5});
  const auto shape = person_shapes(camera, {track}, world_from_camera).at(0);
  for (std::size_t i = 0; i < shape.surface.size(); ++i) {
    const Eigen::Vector3f in_camera = camera.point(track.visible.cells[i], track.visible.depth_m[i]);
    EXPECT_NEAR(shape.surface[i][0], 10.0F + in_camera.z(), 1e-4F);
    EXPECT_NEAR(shape.surface[i][1], 20.0F - in_camera.x(), 1e-4F);
    EXPECT_NEAR(shape.surface[i][2], 1.5F - in_camera.y(), 1e-4F);
  }
  EXPECT_NEAR(shape.velocity_m_per_s[0], -1.0F, 1e-5F);
  EXPECT_NEAR(shape.velocity_m_per_s[1], -0.5F, 1e-5F);
  EXPECT_NEAR(shape.velocity_m_per_s[2], 0.0F, 1e-5F);
}

TEST_F(PersonShapesTest, WhoIsHiddenStandsWhereHeMustBe) {
  track.shape = track.visible;
  track.visible.clear();
  const auto shape = person_shapes(camera, {track}, SE3()).at(0);
  EXPECT_TRUE(shape.hidden);
  EXPECT_EQ(shape.surface.size(), track.shape.size());
}

TEST_F(PersonShapesTest, NobodyIsNobody) {
  EXPECT_TRUE(person_shapes(camera, {}, SE3()).empty());
  EXPECT_EQ(person_shapes(camera, {PersonTrack()}, SE3()).at(0).surface.size(), 0U);
}

}  // namespace
}  // namespace cpslam
