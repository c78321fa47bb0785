// Which detector rgbd_tum runs when nobody says: the network that comes with CP-SLAM, where there is one.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>

#include "detect/generated_network.h"
#include "programs/office_sequence.h"

namespace cpslam {
namespace {

using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

/// Runs a copy of rgbd_tum in a folder of its own, as if nothing of CP-SLAM were installed.
class BundledDetector : public testing::Test {
 protected:
  void SetUp() override {
    if (fs::exists(CPSLAM_INSTALLED_DATA "/models/yc.weights"))
      GTEST_SKIP() << "there is an installation in " CPSLAM_INSTALLED_DATA;
    unsetenv("CPSLAM_DATA");
    fs::create_directories(folder_.file("prefix/bin"));
    fs::copy_file(RGBD_TUM_PATH, program());
  }
  void TearDown() override { unsetenv("CPSLAM_DATA"); }

  [[nodiscard]] std::string program() const { return folder_.file("prefix/bin/rgbd_tum"); }
  void put_network(const std::string& where) const {
    GeneratedNetwork network;
    network.input = {64, 64};
    folder_.write(where + "/models/yc.cfg", network.config());
    folder_.write(where + "/models/yc.weights", weights_file(network.weights()));
  }
  [[nodiscard]] ProgramResult track(const std::vector<std::string>& options = {}) const {
    const fs::path vocabulary = fs::path(RGBD_TUM_PATH).parent_path() / "Vocabulary/cpslam.voc";
    std::vector<std::string> all{program(),      vocabulary, office_.settings(), office_.path(),
                                 "--max-frames", "2",        "--output",         office_.output()};
    all.insert(all.end(), options.begin(), options.end());
    return run_program(all);
  }
  [[nodiscard]] nlohmann::json detector() const { return office_.stats()["settings"]["detector"]; }
  void expect_runs(const std::string& where) const {
    const ProgramResult result = track();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("people are not looked for")));
    EXPECT_EQ(detector()["kind"], "yolo");
    EXPECT_EQ(detector()["model_weights"], folder_.file(where + "/models/yc.weights"));
    EXPECT_EQ(office_.stats()["people"]["detections"], 2);
  }

  TemporaryFolder folder_;
  const OfficeSequence office_;
};

TEST_F(BundledDetector, WithoutItNobodyIsLookedForAndThatIsSaid) {
  folder_.write("prefix/bin/models/yc.cfg", "alone");
  const ProgramResult result = track();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(count_lines(result.err, "note: people are not looked for: 'models/yc.weights' is not in '" +
                                        folder_.file("prefix/bin")),
            1U)
      << result.err;
  EXPECT_EQ(detector()["kind"], "none");
  EXPECT_THAT(track({"--detector", "none"}).err, Not(HasSubstr("people are not looked for")));
  EXPECT_EQ(track({"--quiet"}).err, "");
  expect_refused(track({"--quiet", "--detector", "yolo"}),
                 {"--model CFG WEIGHTS", "models/yc.weights", "prefix/bin"});
  const ProgramResult help = run_program({program(), "--help"});
  EXPECT_THAT(help.out, HasSubstr("else none"));
  EXPECT_THAT(help.out, HasSubstr("models/yc.weights"));
}

TEST_F(BundledDetector, IsTheDefaultWhereverItLies) {
  put_network("anywhere");
  setenv("CPSLAM_DATA", folder_.file("anywhere").c_str(), 1);
  expect_runs("anywhere");
  put_network("prefix/" CPSLAM_DATA_IN_PREFIX);
  expect_runs("prefix/" CPSLAM_DATA_IN_PREFIX);
  put_network("prefix/bin");
  expect_runs("prefix/bin");
  EXPECT_THAT(run_program({program(), "--help"}).out, HasSubstr("prefix/bin/models/yc.weights"));
}

TEST_F(BundledDetector, GivesWayToWhatTheCommandLineSays) {
  put_network("prefix/bin");
  EXPECT_EQ(track({"--detector", "none"}).exit_code, 0);
  EXPECT_EQ(detector()["kind"], "none");
  const std::string boxes = folder_.write("boxes.txt", "1.0 1 1 10 20 0.5\n");
  EXPECT_EQ(track({"--boxes", boxes}).exit_code, 0);
  EXPECT_EQ(detector()["kind"], "boxes");
  EXPECT_EQ(track({"--confidence", "0.7", "--weak-confidence", "0.2", "--input-size", "96x64"}).exit_code, 0);
  EXPECT_EQ(detector()["kind"], "yolo");
  EXPECT_EQ(detector()["confidence_threshold"], 0.7);
  EXPECT_EQ(detector()["weak_confidence_threshold"], 0.2);
  EXPECT_EQ(detector()["input_width"], 96);
  put_network("other");
  EXPECT_EQ(track({"--model", folder_.file("other/models/yc.cfg"), folder_.file("other/models/yc.weights")})
                .exit_code,
            0);
  EXPECT_EQ(detector()["model_cfg"], folder_.file("other/models/yc.cfg"));
}

}  // namespace
}  // namespace cpslam
