// rgbd_tum refuses what it cannot run on: one line that names the file, line or key, and exit code 2.
#include <gmock/gmock.h>

#include "io/temporary_folder.h"
#include "programs/program_run.h"

namespace cpslam {
namespace {

// Lists are read before any image, so these tests need no images.
class BadInput : public testing::Test {
 protected:
  BadInput() {
    write_list("rgb.txt", "1.0 rgb/1.png\n2.0 rgb/2.png\n");
    write_list("depth.txt", "1.01 depth/1.png\n2.01 depth/2.png\n");
  }
  std::string write_list(const std::string& name, const std::string& text) const {
    return folder_.write("sequence/" + name, text);
  }
  [[nodiscard]] ProgramResult run(const std::vector<std::string>& more = {}) const {
    return run_with(vocabulary_, settings_, more);
  }
  [[nodiscard]] ProgramResult run_with(const std::string& vocabulary, const std::string& settings,
                                       const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{vocabulary, settings,   folder_.file("sequence"),
                                 "--quiet",  "--output", folder_.file("results")};
    all.insert(all.begin() + 3, more.begin(), more.end());
    return run_rgbd_tum(all);
  }

  TemporaryFolder folder_;
  std::string vocabulary_ = "-";
  std::string settings_ = CPSLAM_SOURCE_DIR "/Examples/RGB-D/TUM1.yaml";
};

TEST_F(BadInput, MissingSettings) {
  expect_refused(run_with("-", folder_.file("no_such.yaml")), {"rgbd_tum: ", "no_such.yaml"});
}

TEST_F(BadInput, UnreadableSettings) {
  expect_refused(run_with("-", folder_.path()), {folder_.path(), "folder"});
  expect_refused(run_with("-", folder_.write("empty.yaml", "")), {"empty.yaml", "empty"});
}

TEST_F(BadInput, UnknownSettingsKey) {
  const std::string text = TemporaryFolder::content(settings_) + "Camera.fxx: 500\n";
  expect_refused(run_with("-", folder_.write("typo.yaml", text)), {"typo.yaml", "Camera.fxx"});
}

TEST_F(BadInput, SettingOutOfItsRange) {
  const std::string text = TemporaryFolder::content(settings_) + "Tracking.minInliers: 0\n";
  expect_refused(run_with("-", folder_.write("zero.yaml", text)), {"zero.yaml", "Tracking.minInliers"});
}

TEST_F(BadInput, MissingVocabulary) {
  expect_refused(run_with(folder_.file("ORBvoc.txt"), settings_), {"ORBvoc.txt"});
}

TEST_F(BadInput, MissingSequence) {
  const ProgramResult result = run_rgbd_tum({"-", settings_, folder_.file("no_such"), "--quiet"});
  expect_refused(result, {"no_such"});
}

TEST_F(BadInput, MissingList) {
  std::filesystem::remove(folder_.file("sequence/rgb.txt"));
  expect_refused(run(), {"rgb.txt"});
}

TEST_F(BadInput, EmptyLists) {
  write_list("depth.txt", "");
  expect_refused(run(), {"depth.txt", "empty"});
  write_list("rgb.txt", "# timestamp filename\n");
  expect_refused(run(), {"rgb.txt", "no image"});
}

TEST_F(BadInput, ListOfOtherForm) {
  write_list("rgb.txt", "1.0 rgb/1.png\n2.0\n");
  expect_refused(run(), {"rgb.txt:2: "});
}

TEST_F(BadInput, UnsortedList) {
  write_list("rgb.txt", "# comment\n2.0 rgb/2.png\n1.0 rgb/1.png\n");
  expect_refused(run(), {"rgb.txt:3: ", "sort"});
}

TEST_F(BadInput, StampThatIsNoNumber) {
  write_list("depth.txt", "1.0 depth/1.png\nnan depth/2.png\n");
  expect_refused(run(), {"depth.txt:2: ", "nan"});
}

TEST_F(BadInput, ListsWithoutACommonTime) {
  write_list("depth.txt", "101 depth/1.png\n102 depth/2.png\n");
  expect_refused(run(), {"rgb.txt", "depth.txt"});
}

TEST_F(BadInput, StartBeyondTheEnd) {
  expect_refused(run({"--start", "2"}), {"--start 2", "2"});
}

TEST_F(BadInput, MissingAssociations) {
  expect_refused(run({folder_.file("no_such.txt")}), {"no_such.txt"});
}

TEST_F(BadInput, RepeatedStampInAssociations) {
  const std::string associations =
      folder_.write("pairs.txt", "1.0 rgb/1.png 1.0 depth/1.png\n1.0 rgb/2.png 1.0 depth/2.png\n");
  expect_refused(run({associations}), {"pairs.txt:2: ", "1.0", "repeats"});
}

TEST_F(BadInput, StampThatIsNoNumberInAssociations) {
  const std::string associations = folder_.write("pairs.txt", "1.0 rgb/1.png inf depth/1.png\n");
  expect_refused(run({associations}), {"pairs.txt:1: ", "inf"});
}

TEST_F(BadInput, NoImageAtAll) {
  const ProgramResult result = run();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  const std::vector<std::string> lines = lines_of(result.err);
  ASSERT_EQ(lines.size(), 3U) << result.err;
  EXPECT_THAT(lines[0], testing::HasSubstr("rgb/1.png"));
  EXPECT_THAT(lines[1], testing::HasSubstr("rgb/2.png"));
  EXPECT_THAT(lines[2], testing::HasSubstr("none of its 2 frames"));
}

}  // namespace
}  // namespace cpslam
