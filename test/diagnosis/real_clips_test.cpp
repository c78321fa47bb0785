// What the doctor says about recordings of real cameras.
#include <gmock/gmock.h>

#include "diagnosis/examination.h"
#include "diagnosis/findings.h"
#include "support/shared_data.h"

namespace cpslam::diagnosis {
namespace {

Findings examine(const std::string& clip, const std::string& settings) {
  const auto folder = shared_data_dir() / clip;
  const CameraSettings camera = load_settings(CPSLAM_SOURCE_DIR "/Examples/RGB-D/" + settings).camera;
  Examination examination(camera);
  const std::vector<RgbdEntry> entries = associate_sequence(folder.string());
  for (const std::size_t i : choose_frames(entries.size(), 150)) examination.add(read_rgbd(entries[i]));
  return examination.findings();
}

bool is_there(const std::string& clip) {
  return std::filesystem::exists(shared_data_dir() / clip / "rgb.txt");
}

TEST(RealClips, Freiburg1Desk) {
  if (!is_there("fr1_desk_dev")) GTEST_SKIP() << "no fr1_desk_dev in " << shared_data_dir();
  const Findings findings = examine("fr1_desk_dev", "TUM1.yaml");
  EXPECT_LE(worst_level(findings), Level::kWarning) << texts_above(findings, Level::kWarning);
  EXPECT_NEAR(value_of(findings, "depth scale", "median_m"), 1.0, 0.3);
  EXPECT_NEAR(value_of(findings, "registration", "right_px"), 0.0, 3.0);
  // Its depth is known to lag.
  EXPECT_NEAR(value_of(findings, "time offset", "delay_s"), 0.02, 0.01);
}

TEST(RealClips, BonnCrowd) {
  if (!is_there("bonn_crowd_dev")) GTEST_SKIP() << "no bonn_crowd_dev in " << shared_data_dir();
  const Findings findings = examine("bonn_crowd_dev", "Bonn.yaml");
  EXPECT_LE(worst_level(findings), Level::kNote) << texts_above(findings, Level::kNote);
  EXPECT_NEAR(value_of(findings, "registration", "right_px"), 1.0, 2.0);
  EXPECT_NEAR(value_of(findings, "registration", "down_px"), 1.4, 2.0);
}

}  // namespace
}  // namespace cpslam::diagnosis
