#include "diagnosis/depth_coverage.h"

#include <gmock/gmock.h>

#include "diagnosis/findings.h"

namespace cpslam::diagnosis {
namespace {

using testing::HasSubstr;

constexpr const char* kName = "valid depth";

/// n frames whose top `share` has readings.
void add_frames(DepthCoverageCheck& check, int n, double share) {
  ExaminedFrame frame;
  frame.readings = cv::Mat::zeros(300, 300, CV_32FC1);
  frame.readings.rowRange(0, static_cast<int>(300 * share)).setTo(1.0F);
  for (int i = 0; i < n; ++i) check.add(frame);
}

TEST(DepthCoverage, CountsThePixels) {
  DepthCoverageCheck check;
  add_frames(check, 5, 0.9);
  EXPECT_NEAR(value_of(check.findings(), kName, "median_share"), 0.9, 1e-9);
  EXPECT_EQ(worst_level(check.findings()), Level::kOk);
}

TEST(DepthCoverage, LittleDepthIsAWarningHardlyAnyAnError) {
  DepthCoverageCheck little, hardly;
  add_frames(little, 5, 0.3);
  add_frames(hardly, 5, 0.1);
  EXPECT_EQ(worst_of(little.findings(), kName).level, Level::kWarning);
  EXPECT_EQ(worst_of(hardly.findings(), kName).level, Level::kError);
  EXPECT_FALSE(worst_of(hardly.findings(), kName).advice.empty());
}

TEST(DepthCoverage, SomePoorFramesAreAWarning) {
  DepthCoverageCheck check;
  add_frames(check, 90, 0.9);
  add_frames(check, 10, 0.0);
  EXPECT_EQ(worst_level(check.findings()), Level::kWarning);
  EXPECT_NEAR(value_of(check.findings(), kName, "poor_frames_share"), 0.1, 1e-9);
  EXPECT_EQ(value_of(check.findings(), kName, "least_share"), 0.0);
}

TEST(DepthCoverage, AHoleIsNamedByItsPlace) {
  ExaminedFrame frame;
  frame.readings = cv::Mat::ones(300, 300, CV_32FC1);
  frame.readings(cv::Rect(200, 100, 100, 100)).setTo(0.0F);
  DepthCoverageCheck check;
  check.add(frame);
  const Finding hole = worst_of(check.findings(), kName);
  EXPECT_EQ(hole.level, Level::kNote);
  EXPECT_THAT(hole.what, HasSubstr("the right ninth"));
}

TEST(DepthCoverage, InvalidReadingsDoNotCount) {
  RgbdImages images;
  images.colour = cv::Mat::zeros(2, 3, CV_8UC3);
  images.depth = (cv::Mat_<float>(2, 3) << 1.0F, -1.0F, 0.0F, std::nanf(""), INFINITY, 2.0F);
  const ExaminedFrame frame = make_examined_frame(images);
  EXPECT_EQ(cv::countNonZero(frame.readings), 2);
  EXPECT_EQ(frame.readings.at<float>(1, 0), 0.0F);
  EXPECT_EQ(frame.readings.at<float>(1, 1), 0.0F);
}

}  // namespace
}  // namespace cpslam::diagnosis
