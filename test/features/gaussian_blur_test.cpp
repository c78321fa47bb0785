#include "features/gaussian_blur.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "features/image_pyramid.h"
#include "test_images.h"

namespace cpslam {
namespace {

TEST(GaussianBlur, EqualsOpenCvToTheBit) {
  for (const cv::Size size : {cv::Size(320, 240), cv::Size(97, 43), cv::Size(39, 39)}) {
    for (const Simd simd : test::simds()) {
      GaussianBlur blur(simd);
      for (const cv::Mat& image :
           {test::noise_image(size.width, size.height, 7), cv::Mat(size, CV_8UC1, cv::Scalar(255)),
            test::textured_image(size.width, size.height, 8)}) {
        ImagePyramid pyramid(1.2, 1);
        pyramid.build(image);
        cv::Mat expected;
        cv::GaussianBlur(image, expected, cv::Size(7, 7), 2.0, 2.0, cv::BORDER_REFLECT_101);
        EXPECT_EQ(cv::norm(blur.blur(pyramid.level(0)), expected, cv::NORM_INF), 0.0) << size;
      }
    }
  }
}

}  // namespace
}  // namespace cpslam
