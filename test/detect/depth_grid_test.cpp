#include "detect/depth_grid.h"

#include <gtest/gtest.h>

#include <limits>

namespace cpslam {
namespace {

TEST(DepthGrid, HasOneCellForFourPixelsEachWay) {
  const cv::Mat1f grid = reduce_depth(cv::Mat(10, 18, CV_16UC1, cv::Scalar(5000)), 1.0 / 5000.0);
  EXPECT_EQ(grid.size(), cv::Size(4, 2));
  EXPECT_FLOAT_EQ(grid(1, 3), 1.0F);
}

TEST(DepthGrid, NeverMixesTwoSurfaces) {
  cv::Mat raw(4, 4, CV_16UC1, cv::Scalar(3000));
  raw.colRange(2, 4).setTo(1000);
  const float depth_m = reduce_depth(raw, 0.001)(0, 0);
  EXPECT_TRUE(depth_m == 1.0F || depth_m == 3.0F) << depth_m;
}

TEST(DepthGrid, TakesNoSingleNearReadingOfFour) {
  cv::Mat raw(4, 4, CV_16UC1, cv::Scalar(3000));
  raw.at<std::uint16_t>(1, 1) = 500;
  EXPECT_FLOAT_EQ(reduce_depth(raw, 0.001)(0, 0), 3.0F);
}

TEST(DepthGrid, TakesWhatIsValid) {
  cv::Mat raw(4, 8, CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  raw.at<float>(3, 3) = 2.0F;
  const cv::Mat1f grid = reduce_depth(raw, 1.0);
  EXPECT_FLOAT_EQ(grid(0, 0), 2.0F);
  EXPECT_FLOAT_EQ(grid(0, 1), 0.0F);
}

}  // namespace
}  // namespace cpslam
