#include "slam/frame_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace cpslam {
namespace {

using testing::HasSubstr;

cv::Mat image(int type, int width = 640, int height = 480) {
  return cv::Mat::zeros(height, width, type);
}

TEST(FrameInput, GreyIsTheImageItselfOrItsLuminance) {
  const cv::Mat grey = image(CV_8UC1);
  EXPECT_EQ(to_grey(grey).data, grey.data);
  const cv::Mat red(480, 640, CV_8UC3, cv::Scalar(0, 0, 255));
  const cv::Mat of_red = to_grey(red);
  ASSERT_EQ(of_red.type(), CV_8UC1);
  EXPECT_NEAR(of_red.at<std::uint8_t>(5, 5), 0.299 * 255.0, 1.0);
}

TEST(FrameInput, MedianDepthIgnoresWhatIsNoReading) {
  cv::Mat depth(480, 640, CV_16UC1, cv::Scalar(0));
  EXPECT_EQ(median_depth_m(depth, 5000.0), 0.0);
  depth(cv::Rect(0, 0, 300, 480)).setTo(10000);
  depth(cv::Rect(300, 0, 100, 480)).setTo(40000);
  EXPECT_DOUBLE_EQ(median_depth_m(depth, 5000.0), 2.0);
  cv::Mat metres(480, 640, CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(median_depth_m(metres, 1.0), 0.0);
  metres(cv::Rect(0, 0, 64, 480)).setTo(1.5F);
  metres(cv::Rect(64, 0, 32, 480)).setTo(std::numeric_limits<float>::infinity());
  metres(cv::Rect(96, 0, 500, 480)).setTo(-3.0F);
  EXPECT_DOUBLE_EQ(median_depth_m(metres, 1.0), 1.5);
}

class DepthScaleWarning : public testing::Test {
 protected:
  std::string warning_for(double units, double factor) {
    std::string text;
    const Log log([&](LogLevel level, const std::string& message) {
      EXPECT_EQ(level, LogLevel::kWarning);
      text += message;
    });
    warn_about_depth_scale(cv::Mat(480, 640, CV_16UC1, cv::Scalar(units)), factor, log);
    return text;
  }
};

TEST_F(DepthScaleWarning, NamesTheKeyWhenTheSceneIsImplausible) {
  EXPECT_EQ(warning_for(10000, 5000.0), "");
  EXPECT_THAT(warning_for(2000, 5000.0 * 5.0), HasSubstr("DepthMapFactor"));
  EXPECT_THAT(warning_for(40000, 1000.0), HasSubstr("40.0"));
  EXPECT_THAT(warning_for(0, 5000.0), HasSubstr("no valid reading"));
}

TEST_F(DepthScaleWarning, PlausibleRangeIsFromThirtyCentimetresToTenMetres) {
  EXPECT_EQ(warning_for(301, 1000.0), "");
  EXPECT_NE(warning_for(299, 1000.0), "");
  EXPECT_EQ(warning_for(9999, 1000.0), "");
  EXPECT_NE(warning_for(10001, 1000.0), "");
}

}  // namespace
}  // namespace cpslam
