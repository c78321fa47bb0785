#include "diagnosis/depth_scale.h"

#include <gmock/gmock.h>

#include "diagnosis/findings.h"

namespace cpslam::diagnosis {
namespace {

using testing::HasSubstr;

/// Depths spread evenly from near_m to far_m, in units of a true factor.
Findings judge(double near_m, double far_m, double true_factor, std::optional<double> factor) {
  ExaminedFrame frame;
  frame.readings.create(240, 320, CV_32FC1);
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const double depth_m = near_m + (far_m - near_m) * x / 319.0;
      frame.readings.at<float>(y, x) = static_cast<float>(depth_m * true_factor);
    }
  }
  DepthScaleCheck check(factor);
  check.add(frame);
  return check.findings();
}

TEST(DepthScale, RoomsAreFine) {
  const Findings findings = judge(0.8, 4.0, 5000.0, 5000.0);
  EXPECT_EQ(worst_level(findings), Level::kOk) << texts_above(findings, Level::kOk);
  EXPECT_NEAR(value_of(findings, "depth scale", "median_m"), 2.4, 0.03);
  EXPECT_EQ(worst_level(judge(0.8, 4.0, 1000.0, 1000.0)), Level::kOk);
  EXPECT_EQ(worst_level(judge(0.8, 4.0, 5208.0, 5208.0)), Level::kOk) << "freiburg2";
}

TEST(DepthScale, MillimetresReadAs5000thsAreToldWithTheWayOut) {
  const Finding finding = worst_of(judge(0.6, 3.0, 1000.0, 5000.0), "depth scale");
  EXPECT_EQ(finding.level, Level::kError);
  EXPECT_THAT(finding.advice, HasSubstr("DepthMapFactor"));
  EXPECT_THAT(finding.advice, HasSubstr("1000"));
  EXPECT_THAT(finding.advice, HasSubstr("1.80 m"));
}

TEST(DepthScale, FiveThousandthsReadAsMillimetresAreToldWithTheWayOut) {
  const Finding finding = worst_of(judge(0.8, 4.0, 5000.0, 1000.0), "depth scale");
  EXPECT_EQ(finding.level, Level::kError);
  EXPECT_THAT(finding.advice, HasSubstr("5000"));
}

TEST(DepthScale, AWorldThatMayBeACloseUpIsANote) {
  const Finding finding = worst_of(judge(2.5, 7.0, 1000.0, 5000.0), "depth scale");
  EXPECT_EQ(finding.level, Level::kNote);
  EXPECT_THAT(finding.advice, HasSubstr("1000"));
}

TEST(DepthScale, NoFactorFits) {
  EXPECT_EQ(worst_of(judge(0.8, 4.0, 1.0, 5000.0), "depth scale").level, Level::kWarning);
  EXPECT_EQ(worst_of(judge(0.8, 4.0, 1.0, std::nullopt), "depth scale").level, Level::kWarning);
}

TEST(DepthScale, WithoutSettingsAFactorIsProposed) {
  const Finding millimetres = worst_of(judge(0.8, 4.0, 1000.0, std::nullopt), "depth scale");
  EXPECT_EQ(millimetres.level, Level::kOk);
  EXPECT_THAT(millimetres.what, HasSubstr("1000 (millimetres"));
  const Finding tum = worst_of(judge(0.8, 4.0, 5000.0, std::nullopt), "depth scale");
  EXPECT_EQ(tum.level, Level::kOk);
  EXPECT_THAT(tum.what, HasSubstr("5000 (TUM"));
  EXPECT_EQ(worst_of(judge(0.5, 1.5, 5000.0, std::nullopt), "depth scale").level, Level::kNote) << "both fit";
}

TEST(DepthScale, SaysNothingWithoutReadings) {
  ExaminedFrame frame;
  frame.readings = cv::Mat::zeros(240, 320, CV_32FC1);
  DepthScaleCheck check(5000.0);
  check.add(frame);
  EXPECT_TRUE(check.findings().empty());
}

}  // namespace
}  // namespace cpslam::diagnosis
