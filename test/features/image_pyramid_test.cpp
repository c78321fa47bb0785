#include "features/image_pyramid.h"

#include <gtest/gtest.h>

#include "test_images.h"

namespace cpslam {
namespace {

TEST(ImagePyramid, HasTheLevelSizesOfTheField) {
  ImagePyramid pyramid(1.2, 8);
  pyramid.build(test::noise_image(640, 480, 9));
  const std::vector<cv::Size> expected{{640, 480}, {533, 400}, {444, 333}, {370, 278},
                                       {309, 231}, {257, 193}, {214, 161}, {179, 134}};
  ASSERT_EQ(pyramid.n_levels(), 8);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(pyramid.level(i).size(), expected[static_cast<std::size_t>(i)]) << i;
}

TEST(ImagePyramid, StopsWhereNoKeypointFits) {
  ImagePyramid pyramid(1.2, 8);
  pyramid.build(test::noise_image(38, 480, 9));
  EXPECT_EQ(pyramid.n_levels(), 0);
  pyramid.build(test::noise_image(60, 50, 9));  // 60x50, 50x42; 42x35 is too low
  EXPECT_EQ(pyramid.n_levels(), 2);
  pyramid.build(cv::Mat());
  EXPECT_EQ(pyramid.n_levels(), 0);
}

TEST(ImagePyramid, RowsMayBeReadPastTheirEnd) {
  ImagePyramid pyramid(1.2, 8);
  pyramid.build(test::noise_image(640, 480, 9));
  for (int i = 0; i < 8; ++i) {
    EXPECT_GE(pyramid.level(i).step,
              static_cast<std::size_t>(pyramid.level(i).cols + ImagePyramid::kPaddingPx));
  }
}

}  // namespace
}  // namespace cpslam
