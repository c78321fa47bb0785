#include "features/image_mask.h"

#include <gtest/gtest.h>

#include "cpslam/error.h"

namespace cpslam {
namespace {

TEST(ImageMask, FullSizeMarksTheNearestPixel) {
  cv::Mat mask = cv::Mat::zeros(48, 64, CV_8UC1);
  mask.at<std::uint8_t>(10, 20) = 1;
  const ImageMask m(mask, {64, 48});
  ASSERT_FALSE(m.empty());
  EXPECT_TRUE(m.covers(20.0F, 10.0F));
  EXPECT_TRUE(m.covers(19.6F, 10.4F));
  EXPECT_FALSE(m.covers(19.4F, 10.0F));
  EXPECT_FALSE(m.covers(20.6F, 10.0F));
  EXPECT_FALSE(m.covers(10.0F, 20.0F));
}

TEST(ImageMask, CoarseMasksMarkCellsOfFourAndTheRestBelongsToTheLast) {
  cv::Mat mask = cv::Mat::zeros(12, 16, CV_8UC1);  // of 67 x 49 px
  mask.at<std::uint8_t>(11, 15) = 255;
  mask.at<std::uint8_t>(2, 3) = 255;
  const ImageMask m(mask, {67, 49});
  EXPECT_TRUE(m.covers(66.0F, 48.0F));
  EXPECT_TRUE(m.covers(60.0F, 44.0F));
  EXPECT_FALSE(m.covers(59.0F, 48.0F));
  EXPECT_TRUE(m.covers(12.0F, 8.0F));
  EXPECT_TRUE(m.covers(15.0F, 11.0F));
  EXPECT_FALSE(m.covers(16.0F, 8.0F));
  EXPECT_FALSE(m.covers(12.0F, 12.0F));
}

TEST(ImageMask, NothingMarkedIsEmpty) {
  EXPECT_TRUE(ImageMask({}, {64, 48}).empty());
  EXPECT_TRUE(ImageMask(cv::Mat::zeros(48, 64, CV_8UC1), {64, 48}).empty());
  EXPECT_TRUE(ImageMask(cv::Mat::zeros(12, 16, CV_8UC1), {64, 48}).empty());
}

TEST(ImageMask, RefusesWhatDoesNotFit) {
  EXPECT_THROW(ImageMask(cv::Mat::zeros(48, 63, CV_8UC1), {64, 48}), InputError);
  EXPECT_THROW(ImageMask(cv::Mat::zeros(24, 32, CV_8UC1), {64, 48}), InputError);
  EXPECT_THROW(ImageMask(cv::Mat::zeros(48, 64, CV_8UC3), {64, 48}), InputError);
}

}  // namespace
}  // namespace cpslam
