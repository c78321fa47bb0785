#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "io/temporary_folder.h"
#include "programs/program_run.h"
#include "sim/presets.h"

namespace cpslam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Files below a folder, with a slash between the names, sorted.
std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), folder).string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(SimulateTum, ListsThePresets) {
  const ProgramResult result = run_simulate_tum({"--list-presets"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(lines_of(result.out).size(), sim::presets().size());
  for (const sim::PresetInfo& preset : sim::presets()) EXPECT_THAT(result.out, HasSubstr(preset.name));
}

TEST(SimulateTum, HelpAndVersion) {
  const ProgramResult help = run_simulate_tum({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("--list-presets"));
  const ProgramResult version = run_simulate_tum({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.out, "simulate_tum (CP-SLAM) " CPSLAM_VERSION "\n");
}

TEST(SimulateTum, BadArgumentsAreNamed) {
  const TemporaryFolder folder;
  const std::string target = folder.file("sequence");
  expect_refused(run_simulate_tum({}), {"PRESET", "OUTPUT_DIR", "--help"});
  expect_refused(run_simulate_tum({"moon_landing", target}), {"moon_landing", "office_xyz"});
  expect_refused(run_simulate_tum({"office_xyz", target, "--frames", "0"}), {"frames", "0"});
  expect_refused(run_simulate_tum({"walking_xyz", target, "--people", "99"}), {"people", "99"});
  expect_refused(run_simulate_tum({"office_xyz", target, "--bogus"}), {"--bogus"});
  EXPECT_FALSE(fs::exists(target));
}

TEST(SimulateTum, RefusesAFolderInUseUnlessForced) {
  const TemporaryFolder folder;
  folder.write("mine.txt", "keep");
  const std::vector<std::string> arguments{"office_static", folder.path(), "--frames", "1", "--quiet"};
  expect_refused(run_simulate_tum(arguments), {folder.path(), "not empty", "--force"});
  EXPECT_EQ(folder.file_count(), 1U);
  std::vector<std::string> forced = arguments;
  forced.emplace_back("--force");
  const ProgramResult result = run_simulate_tum(forced);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out + result.err, "");
  EXPECT_EQ(TemporaryFolder::content(folder.file("mine.txt")), "keep");
  EXPECT_TRUE(fs::exists(folder.file("rgb.txt")));
}

TEST(SimulateTum, AFileInTheWayIsNamed) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "mine");
  expect_refused(run_simulate_tum({"office_static", file, "--frames", "1", "--quiet"}), {file});
}

TEST(SimulateTum, SameSeedSameFiles) {
  const TemporaryFolder folder;
  const auto simulate = [&folder](const std::string& name, const std::string& seed) {
    const ProgramResult result = run_simulate_tum({"walking_xyz", folder.file(name), "--frames", "2",
                                                   "--noise", "--start", "2", "--seed", seed, "--quiet"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
  };
  simulate("first", "3");
  simulate("second", "3");
  simulate("other", "4");
  const std::vector<std::string> files = files_in(folder.file("first"));
  EXPECT_EQ(files.size(), 2U * 2U + 5U);
  ASSERT_EQ(files, files_in(folder.file("second")));
  ASSERT_EQ(files, files_in(folder.file("other")));
  for (const std::string& file : files) {
    const std::string content = TemporaryFolder::content(folder.file("first/" + file));
    EXPECT_FALSE(content.empty() && file != "person_boxes.txt") << file;
    EXPECT_EQ(content, TemporaryFolder::content(folder.file("second/" + file))) << file;
    if (fs::path(file).extension() == ".png") {
      EXPECT_NE(content, TemporaryFolder::content(folder.file("other/" + file))) << file;
    }
  }
}

}  // namespace
}  // namespace cpslam
