#include "detect/yolo_decoder.h"

#include <gtest/gtest.h>

#include <limits>

namespace cpslam {
namespace {

const cv::Size kInput(200, 100);

/// Rows of centre x, y, width, height (shares), objectness, scores of three classes.
cv::Mat rows(const std::vector<std::vector<float>>& values) {
  cv::Mat output(static_cast<int>(values.size()), 8, CV_32FC1);
  for (int r = 0; r < output.rows; ++r) {
    for (int c = 0; c < output.cols; ++c) {
      output.at<float>(r, c) = values[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
    }
  }
  return output;
}

TEST(YoloDecoder, GivesPixelsMostConfidentFirst) {
  const cv::Mat fine = rows({{0.5F, 0.5F, 0.1F, 0.4F, 0.9F, 0.6F, 0.0F, 0.0F}});
  const cv::Mat coarse = rows({{0.1F, 0.2F, 0.4F, 0.2F, 0.9F, 0.8F, 0.0F, 0.0F}});
  const std::vector<PersonBox> boxes = decode_yolo({fine, coarse}, kInput, {0}, {});
  ASSERT_EQ(boxes.size(), 2U);
  EXPECT_FLOAT_EQ(static_cast<float>(boxes[0].confidence), 0.8F);
  EXPECT_NEAR(boxes[0].x, -20.0, 1e-5) << "reaches over the border";
  EXPECT_NEAR(boxes[0].y, 10.0, 1e-5);
  EXPECT_NEAR(boxes[0].width, 80.0, 1e-5);
  EXPECT_NEAR(boxes[0].height, 20.0, 1e-5);
  EXPECT_NEAR(boxes[1].x, 90.0, 1e-5);
  EXPECT_NEAR(boxes[1].y, 30.0, 1e-5);
}

TEST(YoloDecoder, ScoresByTheBestOfTheChosenClasses) {
  const cv::Mat output = rows({{0.5F, 0.5F, 0.1F, 0.1F, 0.9F, 0.4F, 0.5F, 0.8F}});
  const auto confidence = [&](const std::vector<int>& classes) {
    const std::vector<PersonBox> boxes = decode_yolo({output}, kInput, classes, {0.45, 0.45});
    return boxes.empty() ? 0.0F : static_cast<float>(boxes[0].confidence);
  };
  EXPECT_EQ(confidence({0}), 0.0F);
  EXPECT_EQ(confidence({0, 1}), 0.5F);
  EXPECT_EQ(confidence({2, 0}), 0.8F);
}

TEST(YoloDecoder, KeepsTheMoreConfidentOfTwoThatOverlap) {
  // The same size, shifted by a third and a half of the width: intersection over union 1/2 and 1/3.
  const auto shifted = [](float share) {
    return rows({{0.30F, 0.5F, 0.3F, 0.5F, 0.9F, 0.5F, 0.0F, 0.0F},
                 {0.30F + share, 0.5F, 0.3F, 0.5F, 0.9F, 0.0F, 0.7F, 0.0F}});
  };
  const std::vector<PersonBox> near = decode_yolo({shifted(0.1F)}, kInput, {0, 1}, {0.3, 0.45});
  ASSERT_EQ(near.size(), 1U);
  EXPECT_FLOAT_EQ(static_cast<float>(near[0].confidence), 0.7F);
  EXPECT_EQ(decode_yolo({shifted(0.15F)}, kInput, {0, 1}, {0.3, 0.45}).size(), 2U);
  EXPECT_EQ(decode_yolo({shifted(0.1F)}, kInput, {0, 1}, {0.3, 0.55}).size(), 2U);
  EXPECT_EQ(decode_yolo({shifted(0.1F)}, kInput, {0}, {0.3, 0.45}).size(), 1U) << "not among the chosen";
}

TEST(YoloDecoder, LeavesOutBoxesThatAreNone) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const cv::Mat output = rows({{kNan, 0.5F, 0.1F, 0.1F, 0.9F, 0.9F, 0.0F, 0.0F},
                               {0.5F, 0.5F, kInf, 0.1F, 0.9F, 0.9F, 0.0F, 0.0F},
                               {0.5F, 0.5F, 0.1F, 0.1F, 0.9F, kNan, 0.0F, 0.0F},
                               {0.5F, 0.5F, 0.0F, 0.1F, 0.9F, 0.9F, 0.0F, 0.0F},
                               {0.5F, 0.5F, -0.1F, 0.1F, 0.9F, 0.9F, 0.0F, 0.0F},
                               {1.5F, 0.5F, 0.1F, 0.1F, 0.9F, 0.9F, 0.0F, 0.0F}});
  EXPECT_TRUE(decode_yolo({output}, kInput, {0}, {}).empty());
}

TEST(YoloDecoder, BoundsHowFarABoxReaches) {
  const cv::Mat output = rows({{0.5F, 0.5F, 1e30F, 0.5F, 0.9F, 0.9F, 0.0F, 0.0F}});
  const std::vector<PersonBox> boxes = decode_yolo({output}, kInput, {0}, {});
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_EQ(boxes[0].x, -200.0);
  EXPECT_EQ(boxes[0].width, 600.0);
  EXPECT_EQ(boxes[0].height, 50.0);
}

}  // namespace
}  // namespace cpslam
