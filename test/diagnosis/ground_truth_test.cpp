#include "diagnosis/ground_truth.h"

#include <gmock/gmock.h>

#include <vector>

#include "diagnosis/findings.h"

namespace cpslam::diagnosis {
namespace {

Trajectory walk(int n, double start_s) {
  Trajectory truth;
  for (int i = 0; i < n; ++i) {
    StampedPose pose;
    pose.time_s = start_s + 0.01 * i;
    pose.world_from_camera.translation_m = {0.005 * i, 0.0, 0.0};
    truth.push_back(pose);
  }
  return truth;
}

const std::vector<double> kFrames{10.0, 10.5, 11.0, 11.5, 12.0, 12.5, 13.0, 13.5};

TEST(GroundTruth, CoversTheFrames) {
  const Findings findings = check_ground_truth(walk(600, 9.0), kFrames);
  EXPECT_EQ(worst_level(findings), Level::kOk) << texts_above(findings, Level::kOk);
  EXPECT_NEAR(value_of(findings, "ground truth", "rate_hz"), 100.0, 0.01);
  EXPECT_EQ(value_of(findings, "ground truth", "covered_share"), 1.0);
}

TEST(GroundTruth, CoversHalfOrNothing) {
  const Findings half = check_ground_truth(walk(200, 9.9), kFrames);
  EXPECT_EQ(worst_level(half), Level::kWarning);
  EXPECT_EQ(value_of(half, "ground truth", "covered_share"), 0.5);
  EXPECT_EQ(worst_level(check_ground_truth(walk(600, 1e9), kFrames)), Level::kError);
  EXPECT_EQ(worst_level(check_ground_truth({}, kFrames)), Level::kWarning);
}

TEST(GroundTruth, JumpsAndDisorder) {
  Trajectory jump = walk(600, 9.0);
  jump[300].world_from_camera.translation_m[1] = 1.0;
  EXPECT_THAT(worst_of(check_ground_truth(jump, kFrames), "ground truth").what, testing::HasSubstr("jumps"));
  Trajectory disorder = walk(600, 9.0);
  std::swap(disorder[100], disorder[101]);
  EXPECT_THAT(worst_of(check_ground_truth(disorder, kFrames), "ground truth").what,
              testing::HasSubstr("1 stamps go back"));
}

}  // namespace
}  // namespace cpslam::diagnosis
