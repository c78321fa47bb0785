// How rgbd_tum takes its command line.
#include <gmock/gmock.h>

#include <filesystem>

#include "cpslam/settings.h"
#include "programs/office_sequence.h"

namespace cpslam {
namespace {

using testing::HasSubstr;

TEST(CommandLine, NoArgumentsSayWhatIsMissing) {
  expect_refused(run_rgbd_tum({}), {"rgbd_tum: ", "VOCABULARY", "--help"});
  expect_refused(run_rgbd_tum({"-", "settings.yaml"}), {"SEQUENCE"});
}

TEST(CommandLine, HelpNamesEveryOption) {
  const ProgramResult result = run_rgbd_tum({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  for (const char* const word :
       {"VOCABULARY",    "SETTINGS",         "SEQUENCE",       "ASSOCIATIONS",      "--output",
        "--detector",    "--sequential",     "--realtime",     "--start",           "--max-frames",
        "--seed",        "--print-settings", "--quiet",        "--version",         "--boxes",
        "--model",       "--classes",        "--quantise",     "--boxes-policy",    "--boxes-rate",
        "--boxes-delay", "--people-filter",  "--no-reinstate", "--save-boxes",      "--draw",
        "--input-size",  "--confidence",     "--nms",          "--detector-threads"}) {
    EXPECT_THAT(result.out, HasSubstr(word));
  }
}

TEST(CommandLine, VersionIsOneLine) {
  const ProgramResult result = run_rgbd_tum({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "rgbd_tum (CP-SLAM) " CPSLAM_VERSION "\n");
  EXPECT_EQ(result.err, "");
}

TEST(CommandLine, BadOptionsAreNamed) {
  const auto with = [](std::vector<std::string> options) {
    options.insert(options.begin(), {"-", "settings.yaml", "sequence"});
    return run_rgbd_tum(options);
  };
  expect_refused(with({"--bogus"}), {"--bogus"});
  expect_refused(with({"associations.txt", "too_many"}), {"too_many"});
  expect_refused(with({"--detector", "psychic"}), {"--detector", "psychic"});
  expect_refused(with({"--max-frames", "0"}), {"--max-frames", "0"});
  expect_refused(with({"--max-frames", "few"}), {"--max-frames", "few"});
  expect_refused(with({"--start", "-1"}), {"--start", "-1"});
  expect_refused(with({"--sequential", "--realtime"}), {"--sequential", "--realtime"});
  expect_refused(with({"--output"}), {"--output"});
}

TEST(CommandLine, OldScriptsFindTheProgram) {
  const std::filesystem::path link = std::filesystem::path(CPSLAM_SOURCE_DIR) / "Examples/RGB-D/rgbd_tum";
  ASSERT_TRUE(std::filesystem::is_symlink(link));
  const ProgramResult result = run_program({link.string(), "--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("rgbd_tum (CP-SLAM)"));
}

TEST(CommandLine, QuietSaysNothing) {
  const OfficeSequence office;
  const ProgramResult result = office.track({"--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
}

TEST(CommandLine, PrintedSettingsAreTheEffectiveOnes) {
  const OfficeSequence office;
  const ProgramResult result = office.track({"--print-settings", "--quiet", "--max-frames", "2"});
  EXPECT_EQ(result.exit_code, 0);
  const Settings printed = load_settings(office.folder().write("printed.yaml", result.out));
  const Settings given = load_settings(office.settings());
  EXPECT_EQ(printed.camera.width, OfficeSequence::kWidth);
  EXPECT_EQ(printed.camera.fx, given.camera.fx);
  EXPECT_EQ(printed.camera.bf, given.camera.bf);
  EXPECT_EQ(to_yaml(printed), to_yaml(given));
}

}  // namespace
}  // namespace cpslam
