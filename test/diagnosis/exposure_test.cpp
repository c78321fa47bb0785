#include "diagnosis/exposure.h"

#include <gmock/gmock.h>

#include <vector>

#include "diagnosis/findings.h"

namespace cpslam::diagnosis {
namespace {

Findings judge(const std::vector<double>& greys, double burnt_share = 0.0) {
  ExposureCheck check;
  ExaminedFrame frame;
  for (std::size_t i = 0; i < greys.size(); ++i) {
    frame.time_s = static_cast<double>(i) / 30.0;
    frame.grey = cv::Mat(100, 100, CV_8UC1, cv::Scalar(greys[i]));
    frame.grey.rowRange(0, static_cast<int>(100 * burnt_share)).setTo(255);
    check.add(frame);
  }
  return check.findings();
}

TEST(Exposure, LevelsAreTold) {
  EXPECT_EQ(worst_level(judge(std::vector<double>(20, 110.0))), Level::kOk);
  EXPECT_EQ(worst_level(judge(std::vector<double>(20, 25.0))), Level::kWarning) << "dark";
  EXPECT_EQ(worst_level(judge(std::vector<double>(20, 3.0))), Level::kError) << "black";
  EXPECT_EQ(worst_level(judge(std::vector<double>(20, 110.0), 0.1)), Level::kOk) << "a window";
  const Findings burnt = judge(std::vector<double>(20, 110.0), 0.3);
  EXPECT_EQ(worst_level(burnt), Level::kWarning);
  EXPECT_NEAR(value_of(burnt, "exposure", "saturated_share"), 0.3, 1e-9);
}

TEST(Exposure, BlackStretchesAreTold) {
  std::vector<double> greys(95, 110.0);
  greys.resize(100, 0.0);
  EXPECT_EQ(worst_level(judge(greys)), Level::kWarning);
}

TEST(Exposure, JumpsAreToldDriftIsNot) {
  std::vector<double> drift, jumps;
  for (int i = 0; i < 100; ++i) {
    drift.push_back(80.0 + 0.8 * i);
    jumps.push_back(i / 10 % 2 == 0 ? 80.0 : 120.0);
  }
  EXPECT_EQ(worst_level(judge(drift)), Level::kOk);
  const Findings findings = judge(jumps);
  EXPECT_EQ(worst_level(findings), Level::kWarning);
  EXPECT_EQ(value_of(findings, "exposure", "jumps"), 9.0);
  EXPECT_NEAR(value_of(findings, "exposure", "largest_change"), 1.5, 1e-9);
}

}  // namespace
}  // namespace cpslam::diagnosis
