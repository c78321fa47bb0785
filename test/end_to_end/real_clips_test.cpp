// Recorded sequences, where they are at hand.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "cpslam/person_detector.h"
#include "cpslam/system.h"
#include "io/image_reader.h"
#include "io/temporary_folder.h"
#include "io/trajectory_error.h"
#include "io/trajectory_io.h"
#include "io/tum_sequence.h"
#include "support/shared_data.h"

namespace cpslam::e2e {
namespace {

/// Runs a clip in sequential mode, with the detector, vocabulary and map of the wanted settings.
struct RealRun {
  RealRun(const std::string& clip, const std::string& settings_file,
          std::unique_ptr<PersonDetector> detector = nullptr, const Settings& wanted = {},
          const std::string& save_map = {}) {
    Settings settings = load_settings(CPSLAM_SOURCE_DIR "/Examples/RGB-D/" + settings_file);
    settings.sequential = true;
    settings.detector = wanted.detector;
    settings.vocabulary = wanted.vocabulary;
    settings.load_map = wanted.load_map;
    settings.localization = wanted.localization;
    System system(settings, std::move(detector));
    ReadAhead reader(associate_sequence(clip), 8);
    for (RgbdImages images; reader.next(images);) {
      if (!images.error.empty()) throw std::runtime_error(images.error);
      static_cast<void>(system.track(images.colour, images.depth, images.time_s, images.depth_time_s));
    }
    system.shutdown();
    if (!save_map.empty()) system.save_map(save_map);
    statistics = system.statistics();
    trajectory = system.trajectory();
    error = absolute_trajectory_error(read_trajectory(clip + "/groundtruth.txt"), trajectory);
    testing::Test::RecordProperty("tracked", std::to_string(statistics.tracked));
    testing::Test::RecordProperty("ate_rmse_m", std::to_string(error.rmse_m));
  }
  Statistics statistics;
  Trajectory trajectory;
  TrajectoryError error;
};

TEST(RealClipsEndToEnd, Desk) {
  const std::string clip = shared_data_dir().string() + "/fr1_desk_dev";
  if (!std::filesystem::is_directory(clip)) GTEST_SKIP() << "no clip " << clip << "; set CPSLAM_SHARED_DATA";
  const RealRun run(clip, "TUM1.yaml");
  EXPECT_EQ(run.statistics.frames, 250U);
  EXPECT_EQ(run.statistics.tracked, 250U);
  EXPECT_EQ(run.error.pairs, 250U);
  // The aim is 0.015 m; a tenth more leaves room for what other versions of OpenCV and Ceres round.
  EXPECT_LE(run.error.rmse_m, 0.0165);
}

/// Sees nobody, ever.
class Blind : public PersonDetector {
 public:
  std::vector<PersonBox> detect(const cv::Mat& /*colour*/, double /*time_s*/) override { return {}; }
  [[nodiscard]] std::string name() const override { return "sees nobody"; }
};

TEST(RealClipsEndToEnd, ADetectorThatSeesNobodyCostsNothing) {
  const std::string clip = shared_data_dir().string() + "/fr1_desk_dev";
  if (!std::filesystem::is_directory(clip)) GTEST_SKIP() << "no clip " << clip << "; set CPSLAM_SHARED_DATA";
  const RealRun run(clip, "TUM1.yaml", std::make_unique<Blind>());
  EXPECT_EQ(run.statistics.tracked, 250U);
  EXPECT_LE(run.error.rmse_m, 0.0165);
  EXPECT_LE(run.statistics.people.removed_keypoints, run.statistics.people.keypoints / 100);
}

TEST(RealClipsEndToEnd, DeskInItsOwnMap) {
  const std::string clip = shared_data_dir().string() + "/fr1_desk_dev";
  if (!std::filesystem::is_directory(clip)) GTEST_SKIP() << "no clip " << clip << "; set CPSLAM_SHARED_DATA";
  const TemporaryFolder folder;
  Settings settings;
  settings.vocabulary = CPSLAM_SOURCE_DIR "/Vocabulary/cpslam.voc";
  const RealRun mapping(clip, "TUM1.yaml", nullptr, settings, folder.file("desk.map"));
  ASSERT_EQ(mapping.statistics.tracked, 250U);
  settings.load_map = folder.file("desk.map");
  settings.localization = true;
  const RealRun localised(clip, "TUM1.yaml", nullptr, settings);
  EXPECT_GE(localised.statistics.tracked, 248U);
  EXPECT_EQ(localised.statistics.keyframes_created, mapping.statistics.keyframes_created);
  EXPECT_LE(localised.statistics.bridged, 2U);
  EXPECT_LE(localised.error.rmse_m, 0.02);
}

/// The recorded crowd with its boxes.
RealRun run_crowd(const std::string& clip, const DetectorSettings& detection) {
  Settings settings;
  settings.detector = detection;
  settings.detector.kind = DetectorKind::kBoxes;
  settings.detector.boxes_file = clip + "/person_boxes.txt";
  return RealRun(clip, "Bonn.yaml", make_detector(settings.detector), settings);
}

TEST(RealClipsEndToEnd, Crowd) {
  const std::string clip = shared_data_dir().string() + "/bonn_crowd_dev";
  if (!std::filesystem::is_directory(clip)) GTEST_SKIP() << "no clip " << clip << "; set CPSLAM_SHARED_DATA";
  const RealRun run = run_crowd(clip, {});
  EXPECT_EQ(run.statistics.tracked, 380U);
  // The aim is 0.015 m, and single runs reach 0.018; without the filter it is 0.48, a camera that never moves
  // 0.086.
  EXPECT_LE(run.error.rmse_m, 0.020);
  EXPECT_EQ(run.statistics.people.detections, 380U);
  EXPECT_GT(run.statistics.people.removed_keypoints, run.statistics.people.keypoints / 10);
}

TEST(RealClipsEndToEnd, CrowdWithSeldomLateBoxes) {
  const std::string clip = shared_data_dir().string() + "/bonn_crowd_dev";
  if (!std::filesystem::is_directory(clip)) GTEST_SKIP() << "no clip " << clip << "; set CPSLAM_SHARED_DATA";
  DetectorSettings detection;
  detection.policy = BoxesPolicy::kLatest;
  detection.pretend_rate_hz = 6.0;
  detection.pretend_delay_s = 0.15;
  const RealRun run = run_crowd(clip, detection);
  EXPECT_EQ(run.statistics.tracked, 380U);
  EXPECT_LE(run.error.rmse_m, 0.030);
  EXPECT_GT(run.statistics.people.mean_boxes_age_s, 0.15);
}

}  // namespace
}  // namespace cpslam::e2e
