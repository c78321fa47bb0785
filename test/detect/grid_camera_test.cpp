#include "detect/grid_camera.h"

#include <gtest/gtest.h>

#include <limits>

#include "detect/depth_grid.h"
#include "detect/depth_scene.h"
#include "support/tum_cameras.h"

namespace cpslam {
namespace {

void expect_round_trip(const GridCamera& camera) {
  for (const float depth_m : {0.2F, 0.7F, 2.0F, 5.5F, 13.0F}) {
    for (int cell = 0; cell < camera.n_cells(); ++cell)
      ASSERT_EQ(camera.cell_of(camera.point(cell, depth_m)), cell) << depth_m;
  }
}

TEST(GridCamera, FindsEveryCellAgain) {
  expect_round_trip(scene::grid_camera());
}

TEST(GridCamera, FindsEveryCellAgainThroughALens) {
  expect_round_trip(GridCamera(PinholeCamera(tum1_camera())));
}

TEST(GridCamera, PutsAPointAtItsDepth) {
  const GridCamera camera = scene::grid_camera();
  EXPECT_FLOAT_EQ(camera.point(4321, 3.25F).z(), 3.25F);
  EXPECT_TRUE(camera.point(4321, 3.0F).isApprox(3.0F * camera.point(4321, 1.0F)));
}

TEST(GridCamera, LeavesOutWhatNoWholeCellCovers) {
  CameraSettings settings = scene::camera_settings();
  settings.width = 643;
  settings.height = 481;
  const GridCamera camera{PinholeCamera(settings)};
  EXPECT_EQ(camera.size(), cv::Size(160, 120));
  EXPECT_EQ(camera.cell_of_pixel(641.0F, 100.0F), -1);
  EXPECT_EQ(camera.cell_of_pixel(100.0F, 480.4F), -1);
}

TEST(GridCamera, SeesNothingBehindOrBesideTheImage) {
  const GridCamera camera = scene::grid_camera();
  EXPECT_EQ(camera.cell_of({0.0F, 0.0F, -1.0F}), -1);
  EXPECT_EQ(camera.cell_of({0.0F, 0.0F, 0.0F}), -1);
  EXPECT_EQ(camera.cell_of({5.0F, 0.0F, 1.0F}), -1);
  EXPECT_EQ(camera.cell_of({0.0F, -5.0F, 1.0F}), -1);
  const GridCamera lens{PinholeCamera(tum1_camera())};
  EXPECT_EQ(lens.cell_of({5.0F, 0.0F, 1.0F}), -1);
  EXPECT_EQ(lens.cell_of({0.0F, 0.0F, -1.0F}), -1);
}

TEST(GridCamera, KnowsTheCellOfAPixel) {
  const GridCamera camera = scene::grid_camera();
  EXPECT_EQ(camera.cell_of_pixel(0.0F, 0.0F), 0);
  EXPECT_EQ(camera.cell_of_pixel(-0.4F, 0.0F), 0);
  EXPECT_EQ(camera.cell_of_pixel(3.4F, 0.0F), 0);
  EXPECT_EQ(camera.cell_of_pixel(3.6F, 0.0F), 1);
  EXPECT_EQ(camera.cell_of_pixel(0.0F, 4.0F), camera.size().width);
  EXPECT_EQ(camera.cell_of_pixel(639.0F, 479.0F), camera.n_cells() - 1);
  EXPECT_EQ(camera.cell_of_pixel(-0.6F, 0.0F), -1);
  EXPECT_EQ(camera.cell_of_pixel(640.0F, 0.0F), -1);
  EXPECT_EQ(camera.cell_of_pixel(std::numeric_limits<float>::quiet_NaN(), 0.0F), -1);
  EXPECT_EQ(camera.cell_of_pixel(1e30F, 0.0F), -1);
}

}  // namespace
}  // namespace cpslam
