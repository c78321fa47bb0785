#include "features/corner_detector.h"

#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>
#include <set>
#include <tuple>

#include "features/image_pyramid.h"
#include "test_images.h"

namespace cpslam {
namespace {

using CornerSet = std::set<std::tuple<int, int, int>>;

std::vector<Corner> detect(const cv::Mat& image, int first, int second, Simd simd = best_simd()) {
  ImagePyramid pyramid(1.2, 1);
  pyramid.build(image);
  CornerDetector detector(first, second, simd);
  std::vector<Corner> corners;
  detector.detect(pyramid.level(0), corners);
  return corners;
}

CornerSet as_set(const std::vector<Corner>& corners) {
  CornerSet set;
  for (const Corner& c : corners) set.insert({c.x, c.y, c.response});
  return set;
}

CornerSet opencv_fast(const cv::Mat& image, int threshold) {
  std::vector<cv::KeyPoint> keypoints;
  cv::FAST(image, keypoints, threshold, true);
  CornerSet set;
  for (const cv::KeyPoint& k : keypoints) {
    const int x = static_cast<int>(k.pt.x);
    const int y = static_cast<int>(k.pt.y);
    const bool inside = x >= kOrbBorderPx && y >= kOrbBorderPx && x < image.cols - kOrbBorderPx &&
                        y < image.rows - kOrbBorderPx;
    if (inside) set.insert({x, y, static_cast<int>(k.response)});
  }
  return set;
}

TEST(CornerDetector, EqualsOpenCvFastOnTheWholeLevelWhenBothThresholdsAreOne) {
  for (const cv::Size size : {cv::Size(320, 240), cv::Size(333, 101), cv::Size(39, 39), cv::Size(71, 200)}) {
    const cv::Mat image = test::textured_image(size.width, size.height, 4);
    for (const Simd simd : test::simds()) {
      for (const int threshold : {7, 20}) {
        const CornerSet expected = opencv_fast(image, threshold);
        EXPECT_EQ(as_set(detect(image, threshold, threshold, simd)), expected) << size << " " << threshold;
        if (size.width == 320) {
          EXPECT_GT(expected.size(), 100U);
        }
      }
    }
  }
}

TEST(CornerDetector, WeakCornersComeOnlyFromCellsWithoutStrongOnes) {
  const cv::Mat image = test::textured_image(320, 240, 5);
  const CornerSet strong = opencv_fast(image, 20);
  const CornerSet all = opencv_fast(image, 7);
  // 282 x 202 px inside the border: 9 x 6 cells of 32 x 34 px.
  const auto cell = [](const auto& corner) {
    return std::min((std::get<1>(corner) - 19) / 34, 5) * 9 + std::min((std::get<0>(corner) - 19) / 32, 8);
  };
  std::set<int> strong_cells;
  for (const auto& corner : strong) strong_cells.insert(cell(corner));
  CornerSet expected = strong;
  for (const auto& corner : all) {
    if (!strong_cells.contains(cell(corner))) expected.insert(corner);
  }
  ASSERT_GT(expected.size(), strong.size()) << "the picture has no cell with weak corners only";
  EXPECT_LT(expected.size(), all.size());
  EXPECT_EQ(as_set(detect(image, 20, 7)), expected);
}

TEST(CornerDetector, GivesRasterOrder) {
  const std::vector<Corner> corners = detect(test::textured_image(320, 240, 6), 20, 7);
  ASSERT_GT(corners.size(), 100U);
  for (std::size_t i = 1; i < corners.size(); ++i) {
    EXPECT_LT(std::tie(corners[i - 1].y, corners[i - 1].x), std::tie(corners[i].y, corners[i].x));
  }
}

}  // namespace
}  // namespace cpslam
