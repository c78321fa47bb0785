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

std::vector<Corner> detect(const cv::Mat& image, int threshold, Simd simd = best_simd()) {
  ImagePyramid pyramid(1.2, 1);
  pyramid.build(image);
  CornerDetector detector(threshold, simd);
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

TEST(CornerDetector, EqualsOpenCvFastOnTheWholeLevel) {
  for (const cv::Size size : {cv::Size(320, 240), cv::Size(333, 101), cv::Size(39, 39), cv::Size(71, 200)}) {
    const cv::Mat image = test::textured_image(size.width, size.height, 4);
    for (const Simd simd : test::simds()) {
      for (const int threshold : {7, 20}) {
        const CornerSet expected = opencv_fast(image, threshold);
        EXPECT_EQ(as_set(detect(image, threshold, simd)), expected) << size << " " << threshold;
        if (size.width == 320) {
          EXPECT_GT(expected.size(), 100U);
        }
      }
    }
  }
}

TEST(CornerDetector, GivesRasterOrder) {
  const std::vector<Corner> corners = detect(test::textured_image(320, 240, 6), 7);
  ASSERT_GT(corners.size(), 100U);
  for (std::size_t i = 1; i < corners.size(); ++i) {
    EXPECT_LT(std::tie(corners[i - 1].y, corners[i - 1].x), std::tie(corners[i].y, corners[i].x));
  }
}

}  // namespace
}  // namespace cpslam
