#include <gtest/gtest.h>

#include <string>

#include "detect/truth.h"

// The filter against the simulator's exact masks, sensor noise included. Short runs: they show that the
// filter works at all; docs/method.md has the numbers of long ones.

namespace cpslam {
namespace {

void expect_works(const TruthOptions& options) {
  const FilterTruth truth = measure_filter(options);
  ASSERT_GT(truth.on_people, 300U) << "the sequence shows nobody";
  ASSERT_GT(truth.in_boxes, 300U);
  EXPECT_GE(truth.removed_share(), 0.85);
  EXPECT_GE(truth.kept_share(), 0.70);
  EXPECT_GE(truth.elsewhere_kept_share(), 0.95);
  EXPECT_GE(truth.mask_iou(), 0.60);
  testing::Test::RecordProperty("removed", std::to_string(truth.removed_share()));
  testing::Test::RecordProperty("kept", std::to_string(truth.kept_share()));
  testing::Test::RecordProperty("elsewhere_kept", std::to_string(truth.elsewhere_kept_share()));
  testing::Test::RecordProperty("mask_iou", std::to_string(truth.mask_iou()));
}

TruthOptions short_run(const char* preset) {
  TruthOptions options;
  options.preset = preset;
  options.n_frames = 40;
  options.n_people = 5;
  return options;
}

TEST(FilterTruth, PeopleWalkBeforeAMovingCamera) {
  expect_works(short_run("walking_xyz"));
}

TEST(FilterTruth, PeopleWalkBeforeATurningCamera) {
  expect_works(short_run("walking_rpy"));
}

TEST(FilterTruth, DetectionsAreSeldomLateAndInexact) {
  // Before a still camera: who comes into a turning one's view cannot be known before he is detected.
  TruthOptions options = short_run("walking_static");
  options.detection_rate_hz = 6.0;
  options.detection_delay_s = 0.15;
  options.box_jitter = 0.03;
  expect_works(options);
}

}  // namespace
}  // namespace cpslam
