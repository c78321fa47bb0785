#include "viewer/mask_overlay.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "viewer/colours.h"

namespace cpslam::viewer {
namespace {

TEST(MaskOverlay, TintsEachPersonInHisColourAndNobodyNot) {
  cv::Mat1b mask(10, 20, std::uint8_t{0});
  mask(cv::Rect(2, 2, 5, 5)) = 1;
  mask(cv::Rect(12, 2, 5, 5)) = 2;
  const cv::Mat overlay = mask_overlay(mask);
  ASSERT_EQ(overlay.type(), CV_8UC4);
  ASSERT_EQ(overlay.size(), mask.size());
  EXPECT_EQ(overlay.at<cv::Vec4b>(0, 0), cv::Vec4b());
  for (const auto& [x, number] : {std::pair(4, 1U), std::pair(14, 2U)}) {
    const auto inside = overlay.at<cv::Vec4b>(4, x);
    const Colour colour = person_colour(number);
    EXPECT_EQ(inside[0], colour.red);
    EXPECT_EQ(inside[1], colour.green);
    EXPECT_EQ(inside[2], colour.blue);
    EXPECT_LT(inside[3], overlay.at<cv::Vec4b>(2, x)[3]) << "the outline is stronger";
  }
}

TEST(MaskOverlay, NobodyIsNothing) {
  EXPECT_TRUE(mask_overlay({}).empty());
  EXPECT_TRUE(mask_overlay(cv::Mat::zeros(10, 10, CV_8UC1)).empty());
  EXPECT_TRUE(mask_overlay(cv::Mat::ones(10, 10, CV_32FC1)).empty());
}

TEST(MaskOverlay, EveryNumberHasAColour) {
  for (unsigned number = 1; number < 255; ++number)
    EXPECT_EQ(person_colour(number), kPeople[(number - 1) % 6]);
}

}  // namespace
}  // namespace cpslam::viewer
