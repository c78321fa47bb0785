// Whole runs of rgbd_tum on good input: the files it writes and what its options change.
#include <gmock/gmock.h>

#include <filesystem>

#include "io/trajectory_io.h"
#include "programs/office_sequence.h"

namespace cpslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

void expect_counts_add_up(const nlohmann::json& stats) {
  std::size_t sum = 0;
  for (const char* const key : {"tracked", "predicted", "lost", "not_initialized", "unreadable", "dropped"}) {
    sum += stats.at(key).get<std::size_t>();
  }
  EXPECT_EQ(stats.at("frames"), sum);
  EXPECT_NEAR(stats.at("tracked_ratio").get<double>(),
              stats.at("tracked").get<double>() / stats.at("frames").get<double>(), 1e-9);
}

TEST(TrackingRun, WritesTheDocumentedFiles) {
  const OfficeSequence office;
  const ProgramResult result = office.track();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("100 %"));
  EXPECT_THAT(result.out, HasSubstr("12 tracked (100.0 %)"));
  EXPECT_THAT(result.out, HasSubstr("ATE"));
  const Trajectory trajectory = office.trajectory();
  ASSERT_EQ(trajectory.size(), OfficeSequence::kFrames);
  for (std::size_t i = 0; i < trajectory.size(); ++i)
    EXPECT_NEAR(trajectory[i].time_s, office.time_s(i), 1e-5);
  EXPECT_EQ(read_trajectory(office.result("KeyFrameTrajectory.txt")).size(), office.stats()["keyframes"]);
  for (const auto& entry : std::filesystem::directory_iterator(office.output())) {
    EXPECT_THAT(entry.path().filename().string(),
                testing::AnyOf("CameraTrajectory.txt", "KeyFrameTrajectory.txt", "stats.json"));
  }
}

TEST(TrackingRun, StatisticsAreCompleteAndConsistent) {
  const OfficeSequence office;
  ASSERT_EQ(office.track({"--quiet", "--seed", "7"}).exit_code, 0);
  const nlohmann::json stats = office.stats();
  expect_counts_add_up(stats);
  EXPECT_EQ(stats.at("version"), CPSLAM_VERSION);
  EXPECT_EQ(stats.at("sequence"), office.path());
  EXPECT_EQ(stats.at("settings").at("camera").at("width"), OfficeSequence::kWidth);
  EXPECT_EQ(stats.at("settings").at("seed"), 7);
  EXPECT_EQ(stats.at("interrupted"), false);
  EXPECT_EQ(stats.at("tracked"), OfficeSequence::kFrames);
  EXPECT_GE(stats.at("keyframes"), 1);
  EXPECT_GE(stats.at("keyframes_created"), stats.at("keyframes"));
  EXPECT_GE(stats.at("map_points"), 100);
  EXPECT_GE(stats.at("map_points_created"), stats.at("map_points"));
  EXPECT_GE(stats.at("local_bundle_adjustments"), 0);
  ASSERT_FALSE(stats.at("stages").empty());
  for (const nlohmann::json& stage : stats.at("stages")) {
    EXPECT_FALSE(stage.at("stage").get<std::string>().empty());
    EXPECT_GT(stage.at("count"), 0);
    EXPECT_LE(stage.at("p50_ms"), stage.at("p95_ms"));
    EXPECT_LE(stage.at("p95_ms"), stage.at("max_ms"));
    EXPECT_LE(stage.at("max_ms"), stage.at("total_ms"));
  }
  EXPECT_GT(stats.at("tracking_ms").at("p50"), 0.0);
  EXPECT_LE(stats.at("tracking_ms").at("p95"), stats.at("tracking_ms").at("max"));
  EXPECT_GT(stats.at("peak_memory_mb"), 1.0);
  EXPECT_GT(stats.at("wall_s"), 0.0);
  const nlohmann::json ate = stats.at("ate");
  EXPECT_EQ(ate.at("pairs"), OfficeSequence::kFrames);
  EXPECT_GT(ate.at("rmse_m"), 0.0);
  EXPECT_LT(ate.at("rmse_m"), 0.01);
  EXPECT_LE(ate.at("median_m"), ate.at("max_m"));
  EXPECT_LE(ate.at("mean_m"), ate.at("rmse_m"));
}

TEST(TrackingRun, SequentialRunsAreTheSameToTheByte) {
  const OfficeSequence office;
  std::vector<std::string> trajectories, keyframes;
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(office.track({"--quiet", "--sequential"}).exit_code, 0);
    trajectories.push_back(TemporaryFolder::content(office.result("CameraTrajectory.txt")));
    keyframes.push_back(TemporaryFolder::content(office.result("KeyFrameTrajectory.txt")));
  }
  EXPECT_FALSE(trajectories[0].empty());
  EXPECT_EQ(trajectories[0], trajectories[1]);
  EXPECT_EQ(keyframes[0], keyframes[1]);
  EXPECT_EQ(office.stats()["settings"]["sequential"], true);
}

TEST(TrackingRun, PartOfASequence) {
  const OfficeSequence office;
  ASSERT_EQ(office.track({"--quiet", "--start", "3", "--max-frames", "5"}).exit_code, 0);
  const Trajectory trajectory = office.trajectory();
  ASSERT_EQ(trajectory.size(), 5U);
  EXPECT_NEAR(trajectory.front().time_s, office.time_s(3), 1e-5);
  EXPECT_NEAR(trajectory.back().time_s, office.time_s(7), 1e-5);
  EXPECT_EQ(office.stats()["frames"], 5U);
  ASSERT_EQ(office.track({"--quiet", "--start", "10", "--max-frames", "500"}).exit_code, 0);
  EXPECT_EQ(office.trajectory().size(), 2U);
}

TEST(TrackingRun, RealTimeKeepsPace) {
  const OfficeSequence office;
  ASSERT_EQ(office.track({"--quiet", "--realtime"}).exit_code, 0);
  const nlohmann::json stats = office.stats();
  expect_counts_add_up(stats);
  EXPECT_GE(stats["tracked"], 1);
  // No frame is looked at before its time has come.
  EXPECT_GE(stats["wall_s"].get<double>(), static_cast<double>(OfficeSequence::kFrames - 1) / 30.0);
}

TEST(TrackingRun, AssociationsGiveTheSameAsTheLists) {
  const OfficeSequence office;
  ASSERT_EQ(office.track({"--quiet", "--sequential"}).exit_code, 0);
  const std::string from_lists = TemporaryFolder::content(office.result("CameraTrajectory.txt"));
  ASSERT_EQ(office.track({office.associations(office.pairs()), "--quiet", "--sequential"}).exit_code, 0);
  EXPECT_EQ(TemporaryFolder::content(office.result("CameraTrajectory.txt")), from_lists);
}

TEST(TrackingRun, LoopsAreLookedForUnlessToldNotTo) {
  const OfficeSequence office;
  const ProgramResult bundled = office.track({"--max-frames", "3"});
  EXPECT_EQ(bundled.exit_code, 0);
  EXPECT_THAT(bundled.out, HasSubstr("loops       0 closed"));
  EXPECT_THAT(TemporaryFolder::content(office.result("stats.json")), HasSubstr("\"closed\": 0"));
  const ProgramResult without = office.track({"--max-frames", "3", "--no-loop"});
  EXPECT_EQ(without.exit_code, 0);
  EXPECT_THAT(without.out, Not(HasSubstr("loops ")));
  EXPECT_THAT(TemporaryFolder::content(office.result("stats.json")), HasSubstr("\"loops\": null"));
}

TEST(TrackingRun, VocabulariesOfOurOwnAndPublicOnesAreRead) {
  const OfficeSequence office;
  std::string text = "2 1 0 0\n";
  for (const char* const byte : {" 0", " 255"}) {
    text += "0 1";
    for (int i = 0; i < 32; ++i) text += byte;
    text += " 1\n";
  }
  const std::string vocabulary = office.folder().write("small.txt", text);
  const auto run = [&](const std::string& name) {
    return run_rgbd_tum({name, office.settings(), office.path(), "--output", office.output(), "--max-frames",
                         "3", "--detector", "none", "--quiet"});
  };
  for (const std::string& name :
       {vocabulary, std::string("-"), std::string(CPSLAM_SOURCE_DIR "/Vocabulary/cpslam.voc")}) {
    const ProgramResult result = run(name);
    EXPECT_EQ(result.exit_code, 0) << name;
    EXPECT_EQ(result.err, "") << name;
  }
  const ProgramResult broken = run(office.folder().write("broken.txt", "10 6 0 0\n0 0 1 2 3\n"));
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_THAT(broken.err, AllOf(HasSubstr("broken.txt"), HasSubstr("line 2")));
  const ProgramResult missing = run("no_such.voc");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, AllOf(HasSubstr("no_such.voc"), HasSubstr("No such file")));
}

}  // namespace
}  // namespace cpslam
