#include "diagnosis/alignment.h"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "diagnosis/findings.h"
#include "diagnosis/panned_scene.h"

namespace cpslam::diagnosis {
namespace {

using testing::HasSubstr;

constexpr const char* kSpace = "registration";
constexpr const char* kTime = "time offset";
constexpr double kInterval_s = 1.0 / 30.0;

Findings look(
    int n_frames, const PannedScene::Pan& pan, double delay_s,
    const std::function<void(ExaminedFrame&)>& change = [](ExaminedFrame&) {}) {
  const PannedScene scene;
  AlignmentCheck check;
  for (int i = 0; i < n_frames; ++i) {
    ExaminedFrame frame = scene.frame(i * kInterval_s, pan, delay_s);
    change(frame);
    check.add(frame);
  }
  return check.findings();
}

/// Moves and enlarges depth about the picture's middle.
void warp_depth(cv::Mat& readings, double scale, double right_px, double down_px) {
  const double x = 0.5 * (readings.cols - 1), y = 0.5 * (readings.rows - 1);
  const cv::Mat where = (cv::Mat_<double>(2, 3) << scale, 0.0, (1.0 - scale) * x + right_px, 0.0, scale,
                         (1.0 - scale) * y + down_px);
  cv::warpAffine(readings.clone(), readings, where, readings.size(), cv::INTER_NEAREST);
}

cv::Point2d still(double) {
  return {3.0, 4.0};
}

TEST(Alignment, GoodDataAreFine) {
  const Findings findings = look(60, handheld, 0.0);
  EXPECT_EQ(worst_level(findings), Level::kOk) << texts_above(findings, Level::kOk);
  EXPECT_NEAR(value_of(findings, kSpace, "right_px"), 0.0, 0.3);
  EXPECT_NEAR(value_of(findings, kSpace, "down_px"), 0.0, 0.3);
  EXPECT_NEAR(value_of(findings, kTime, "delay_s"), 0.0, 0.002);
}

TEST(Alignment, AShiftOfDepthIsFound) {
  for (const cv::Point2d shift : {cv::Point2d(3.0, 0.0), cv::Point2d(-7.0, 5.0), cv::Point2d(0.0, -12.0)}) {
    const Findings findings = look(60, handheld, 0.0, [&shift](ExaminedFrame& frame) {
      warp_depth(frame.readings, 1.0, shift.x, shift.y);
    });
    EXPECT_NEAR(value_of(findings, kSpace, "right_px"), shift.x, 0.3);
    EXPECT_NEAR(value_of(findings, kSpace, "down_px"), shift.y, 0.3);
    EXPECT_EQ(worst_of(findings, kSpace).level, cv::norm(shift) > 5.0 ? Level::kError : Level::kWarning);
    EXPECT_NEAR(value_of(findings, kTime, "delay_s"), 0.0, 0.004) << "that is no delay";
  }
}

TEST(Alignment, DepthOfAnotherFieldOfViewIsFound) {
  for (const double scale : {0.93, 1.06}) {
    const Findings findings = look(
        30, handheld, 0.0, [scale](ExaminedFrame& frame) { warp_depth(frame.readings, scale, 4.0, 0.0); });
    const Finding finding = worst_of(findings, kSpace);
    EXPECT_EQ(finding.level, Level::kError);
    EXPECT_NEAR(value_of(findings, kSpace, "growth"), 1.0 / scale - 1.0, 0.011);
    EXPECT_THAT(finding.what, HasSubstr(scale < 1.0 ? "too small" : "too large"));
    EXPECT_THAT(finding.advice, HasSubstr("registration"));
  }
}

TEST(Alignment, ADelayOfDepthIsFound) {
  for (const double delay_s : {-0.12, -0.033, -0.01, 0.005, 0.02, 0.05, 0.15}) {
    const Findings findings = look(90, handheld, delay_s);
    EXPECT_NEAR(value_of(findings, kTime, "delay_s"), delay_s, 0.004 + 0.02 * std::abs(delay_s));
    EXPECT_LT(value_of(findings, kTime, "sigma_s"), 0.005);
    const Level expected = std::abs(delay_s) > 0.07    ? Level::kError
                           : std::abs(delay_s) >= 0.02 ? Level::kWarning
                                                       : Level::kOk;
    EXPECT_EQ(worst_of(findings, kTime).level, expected) << delay_s;
    EXPECT_EQ(worst_of(findings, kSpace).level, Level::kOk) << delay_s << ": that is no shift";
  }
}

TEST(Alignment, AdviceForADelayHasTheSign) {
  EXPECT_THAT(worst_of(look(60, handheld, 0.03), kTime).advice, HasSubstr("subtract 0.03"));
  EXPECT_THAT(worst_of(look(60, handheld, -0.03), kTime).advice, HasSubstr("add 0.03"));
}

TEST(Alignment, NoMotionNoDelay) {
  const Findings findings = look(60, still, 0.04);
  EXPECT_EQ(worst_of(findings, kTime).level, Level::kNote);
  EXPECT_THAT(worst_of(findings, kTime).what, HasSubstr("cannot be told"));
  EXPECT_EQ(worst_of(findings, kSpace).level, Level::kOk);
}

TEST(Alignment, EvenMotionNoDelay) {
  // As well a shift of 3 px.
  const auto even = [](double time_s) { return cv::Point2d(-90.0 + 90.0 * time_s, 0.0); };
  const Finding finding = worst_of(look(60, even, 1.0 / 30.0), kTime);
  EXPECT_EQ(finding.level, Level::kNote) << finding.what;
}

TEST(Alignment, DepthOfAnotherSceneIsSuspicious) {
  const PannedScene other(7);
  const Findings findings = look(40, handheld, 0.0, [&other](ExaminedFrame& frame) {
    frame.readings = other.readings(handheld(frame.time_s));
  });
  EXPECT_GE(worst_of(findings, kSpace).level, Level::kNote);
  EXPECT_EQ(worst_of(findings, kTime).level, Level::kNote);
}

TEST(Alignment, AnEmptyWallTellsNothing) {
  const Findings findings = look(30, handheld, 0.0, [](ExaminedFrame& frame) {
    frame.readings.setTo(10000.0);
    frame.grey.setTo(120);
  });
  EXPECT_EQ(worst_of(findings, kSpace).level, Level::kNote);
  EXPECT_EQ(worst_of(findings, kTime).level, Level::kNote);
}

}  // namespace
}  // namespace cpslam::diagnosis
