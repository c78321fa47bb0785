#include "dense/dense_view.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "dense/flat_scene.h"
#include "support/tum_cameras.h"

namespace cpslam {
namespace {

const PinholeCamera kPinhole = flat::camera();

TEST(DenseCamera, PointsFallBackIntoTheirBlocks) {
  for (const CameraSettings& settings : {synthetic::settings().camera, tum1_camera()}) {
    const DenseCamera camera{PinholeCamera(settings)};
    EXPECT_EQ(camera.step(), 2);
    EXPECT_EQ(camera.size(), cv::Size(320, 240));
    for (int pixel = 0; pixel < camera.n_pixels(); pixel += 7)
      ASSERT_EQ(camera.pixel_of(camera.ray(pixel) * 2.5F), pixel);
  }
}

TEST(DenseCamera, WhatIsNotInTheImageIsNowhere) {
  const DenseCamera camera{PinholeCamera(tum1_camera())};
  EXPECT_EQ(camera.pixel_of({0.0F, 0.0F, -1.0F}), -1);
  EXPECT_EQ(camera.pixel_of({0.0F, 0.0F, 0.0F}), -1);
  // Strong distortion bends such rays back into the image.
  for (float x = 1.2F; x < 20.0F; x *= 1.3F) EXPECT_EQ(camera.pixel_of({x, 0.0F, 1.0F}), -1) << x;
}

TEST(DenseCamera, HasSome320BlocksAcrossWhateverTheImage) {
  CameraSettings settings = synthetic::settings().camera;
  settings.width = 1280;
  settings.height = 722;
  EXPECT_EQ(DenseCamera{PinholeCamera(settings)}.size(), cv::Size(320, 180));
  settings.width = 100;
  settings.height = 50;
  EXPECT_EQ(DenseCamera{PinholeCamera(settings)}.size(), cv::Size(100, 50));
}

TEST(DenseView, TakesDepthAndColourOfTheNearestSurfaceInABlock) {
  const DenseCamera camera(kPinhole);
  DenseFrame frame = flat::look(kPinhole, {flat::wall(2.0)});
  auto depth = cv::Mat1w(frame.depth);
  // Block (10, 5): two near readings, one far, one missing.
  depth(10, 20) = 5000;
  depth(10, 21) = 5020;
  depth(11, 20) = 9000;
  depth(11, 21) = 0;
  depth(cv::Rect(40, 40, 2, 2)).setTo(0);
  const DenseView view = make_dense_view(camera, frame);
  EXPECT_EQ(view.depth(5, 10), 5010);
  EXPECT_EQ(view.depth(20, 20), 0);
  EXPECT_EQ(view.depth(100, 100), 10000);
  EXPECT_EQ(view.rgb[100 * 320 + 100], (std::array<std::uint8_t, 3>{100, 150, 200}));
  EXPECT_EQ(view.n_bytes(), 320U * 240U * 5U);
}

TEST(DenseView, FloatDepthWithHostileValuesAndGreyColour) {
  const DenseCamera camera(kPinhole);
  DenseFrame frame;
  frame.metres_per_unit = 0.001;
  frame.colour = cv::Mat(480, 640, CV_8UC1, cv::Scalar(77));
  frame.depth = cv::Mat(480, 640, CV_32FC1, cv::Scalar(1500.0));
  auto depth = cv::Mat1f(frame.depth);
  const float kInf = std::numeric_limits<float>::infinity();
  const float values[] = {
      std::numeric_limits<float>::quiet_NaN(), kInf, -kInf, -5.0F, 1e30F, 14000.0F, 1e-30F};
  for (int i = 0; i < 7; ++i) depth(cv::Rect(20 * i, 0, 2, 2)).setTo(values[i]);
  const DenseView view = make_dense_view(camera, frame);
  for (int i = 0; i < 7; ++i) EXPECT_EQ(view.depth(0, 10 * i), 0) << i;
  EXPECT_EQ(view.depth(50, 50), 7500);
  EXPECT_EQ(view.rgb[50 * 320 + 50], (std::array<std::uint8_t, 3>{77, 77, 77}));
}

TEST(DenseView, WhatMovesIsLeftOutWithAMarginAndItsSurfaceWithAWiderOne) {
  const DenseCamera camera(kPinhole);
  // Somebody at 1.5 m of whom the mask misses the rim, before a wall at 3 m.
  DenseFrame frame = flat::look(kPinhole, {flat::wall(3.0), flat::board(1.5, 0.25)});
  cv::Mat1b person;
  cv::compare(frame.depth, 8000, person, cv::CMP_LT);
  cv::erode(person, frame.moving, cv::Mat(), {-1, -1}, 10);
  const DenseView view = make_dense_view(camera, frame);
  EXPECT_EQ(cv::countNonZero((view.depth > 0) & (view.depth < 8000)), 0);
  // The wall is all there but for a margin of two blocks.
  cv::Mat1b near_person;
  cv::dilate(person, near_person, cv::Mat(), {-1, -1}, 7);
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      if (near_person(y, x) != 0) continue;
      ASSERT_EQ(view.depth(y / 2, x / 2), 15000) << x << " " << y;
    }
  }
}

TEST(DenseView, ColourIsTakenWhereItsCameraSawThePoint) {
  const DenseCamera camera(kPinhole);
  DenseFrame frame = flat::look(kPinhole, {flat::wall(2.0)});
  frame.colour.colRange(0, 320).setTo(cv::Scalar(10, 20, 30));
  // The colour camera stood 0.2 m to the left: things are further right in its image, by 0.2 / 2 * 525 px.
  frame.colour_cam_from_depth_cam.translation.x() = 0.2;
  const DenseView view = make_dense_view(camera, frame);
  const std::array<std::uint8_t, 3> marked{30, 20, 10};
  const std::size_t row = 120 * 320;
  EXPECT_EQ(view.rgb[row + (320 - 54) / 2 - 1], marked);
  EXPECT_NE(view.rgb[row + (320 - 50) / 2], marked);
  EXPECT_EQ(view.depth(120, 319), 0) << "no colour there";
}

}  // namespace
}  // namespace cpslam
