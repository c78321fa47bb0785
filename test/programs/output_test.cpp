// What rgbd_tum leaves behind when writing fails or somebody stops it.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>

#include "programs/office_sequence.h"

namespace cpslam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Output, FileInPlaceOfTheFolder) {
  const OfficeSequence office;
  office.folder().write("results", "mine");
  expect_refused(office.track({"--quiet"}), {"--output", office.output()});
  EXPECT_EQ(TemporaryFolder::content(office.output()), "mine");
}

TEST(Output, FolderThatCannotBeMade) {
  const OfficeSequence office;
  const ProgramResult result =
      run_rgbd_tum({"-", office.settings(), office.path(), "--quiet", "--output", "/proc/no_such_folder"});
  expect_refused(result, {"--output", "/proc/no_such_folder"});
}

TEST(Output, FullDiskCostsOneFileAndIsNamed) {
  const OfficeSequence office;
  fs::create_directories(office.output());
  fs::create_symlink("/dev/full", office.result("CameraTrajectory.txt"));
  const ProgramResult result = office.track({"--quiet"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("CameraTrajectory.txt"));
  EXPECT_THAT(result.err, HasSubstr("No space left"));
  EXPECT_GT(fs::file_size(office.result("KeyFrameTrajectory.txt")), 0U);
  EXPECT_EQ(office.stats()["tracked"], OfficeSequence::kFrames);
}

TEST(Output, FailedWritingKeepsTheOldFiles) {
  const OfficeSequence office;
  fs::create_directories(office.output());
  office.folder().write("results/CameraTrajectory.txt", "of the last run");
  // Room for 512 bytes a file: for the keyframes', not for the others'.
  const ProgramResult result =
      run_program({"/bin/sh", "-c", "trap '' XFSZ; ulimit -f 1; exec \"$0\" \"$@\"", RGBD_TUM_PATH, "-",
                   office.settings(), office.path(), "--quiet", "--output", office.output()});
  EXPECT_EQ(result.ended_by, 0);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(count_lines(result.err, "CameraTrajectory.txt"), 1U) << result.err;
  EXPECT_EQ(count_lines(result.err, "stats.json"), 1U) << result.err;
  EXPECT_EQ(lines_of(result.err).size(), 2U) << result.err;
  EXPECT_EQ(TemporaryFolder::content(office.result("CameraTrajectory.txt")), "of the last run");
  EXPECT_TRUE(fs::exists(office.result("KeyFrameTrajectory.txt")));
  for (const auto& entry : fs::directory_iterator(office.output()))
    EXPECT_NE(entry.path().extension(), ".partial");
}

TEST(Output, BadGroundTruthCostsTheErrorAlone) {
  const OfficeSequence office;
  office.folder().write("office/groundtruth.txt", "# truth\n1000.0 0 0 0 0 0 0 1\n1000.1 0 0 zero 0 0 0 1\n");
  const ProgramResult result = office.track({"--quiet"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("groundtruth.txt:3: "));
  EXPECT_EQ(office.trajectory().size(), OfficeSequence::kFrames);
  EXPECT_TRUE(office.stats()["ate"].is_null());
}

TEST(Output, GroundTruthThatIsNoFile) {
  const OfficeSequence office;
  fs::remove(office.file("groundtruth.txt"));
  fs::create_directory(office.file("groundtruth.txt"));
  const ProgramResult result = office.track({"--quiet"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("groundtruth.txt"));
  EXPECT_EQ(office.trajectory().size(), OfficeSequence::kFrames);
}

TEST(Output, GroundTruthMayBeMissing) {
  const OfficeSequence office;
  fs::remove(office.file("groundtruth.txt"));
  const ProgramResult result = office.track();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(office.stats()["ate"].is_null());
  EXPECT_THAT(result.out, testing::Not(HasSubstr("ATE")));
}

void expect_saved_when_stopped_by(int signal) {
  const OfficeSequence office;
  std::vector<std::pair<std::string, std::string>> pairs;
  for (int round = 0; round < 100; ++round) {
    const auto more = office.pairs(round % 2 == 1);
    pairs.insert(pairs.end(), more.begin(), more.end());
  }
  // The bar writes a line every tenth: nine tenths are left when the signal comes.
  const ProgramResult result = office.track({office.associations(pairs)}, {signal, "10 %"});
  EXPECT_EQ(result.ended_by, 0);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("interrupted"));
  const nlohmann::json stats = office.stats();
  EXPECT_EQ(stats["interrupted"], true);
  const Trajectory trajectory = office.trajectory();
  EXPECT_GE(trajectory.size(), pairs.size() / 10);
  EXPECT_LT(trajectory.size(), pairs.size());
  EXPECT_EQ(stats["tracked"], trajectory.size());
  EXPECT_TRUE(fs::exists(office.result("KeyFrameTrajectory.txt")));
}

TEST(Stopped, InterruptSavesWhatWasTracked) {
  expect_saved_when_stopped_by(SIGINT);
}

TEST(Stopped, TerminationSavesWhatWasTracked) {
  expect_saved_when_stopped_by(SIGTERM);
}

}  // namespace
}  // namespace cpslam
