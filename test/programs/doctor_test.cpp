// cpslam_doctor as users run it: findings, exit codes, JSON.
#include <gmock/gmock.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "programs/office_sequence.h"

namespace cpslam {
namespace {

using testing::HasSubstr;

class Doctor : public testing::Test {
 protected:
  [[nodiscard]] ProgramResult examine(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{CPSLAM_DOCTOR_PATH, office_.path(), "--quiet", "--json", json_path()};
    command.insert(command.end(), more.begin(), more.end());
    return run_program(command);
  }
  [[nodiscard]] std::string json_path() const { return office_.folder().file("findings.json"); }
  [[nodiscard]] nlohmann::json json() const {
    return nlohmann::json::parse(TemporaryFolder::content(json_path()));
  }
  /// Expects exit code 2 and an error of this check whose text has the word.
  void expect_error(const std::string& check, const std::string& word) const {
    const ProgramResult result = examine();
    EXPECT_EQ(result.exit_code, 2) << result.out << result.err;
    EXPECT_EQ(result.err, "");
    const nlohmann::json report = json();
    EXPECT_EQ(report.at("worst"), "error");
    for (const nlohmann::json& finding : report.at("findings")) {
      if (finding.at("level") != "error" || finding.at("check") != check) continue;
      EXPECT_THAT(finding.at("what").get<std::string>(), HasSubstr(word));
      EXPECT_NE(finding.at("advice"), "");
      EXPECT_THAT(result.out, HasSubstr(finding.at("advice").get<std::string>()));
      return;
    }
    ADD_FAILURE() << "no error of " << check << " in\n" << result.out;
  }

  OfficeSequence office_;
};

TEST_F(Doctor, AHealthySequenceIsFine) {
  const ProgramResult result = examine();
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("0 errors, 0 warnings"));
  EXPECT_THAT(result.out, HasSubstr("DepthMapFactor 5000")) << "the sequence's own settings.yaml";
  EXPECT_THAT(result.out, HasSubstr("ground truth"));
  EXPECT_EQ(json().at("examined"), OfficeSequence::kFrames);
  EXPECT_EQ(json().at("settings"), office_.settings());
  EXPECT_FALSE(json().at("findings").empty());
}

TEST_F(Doctor, LooksAtAsManyFramesAsItShall) {
  ASSERT_EQ(examine({"--frames", "5"}).exit_code, 0);
  EXPECT_EQ(json().at("examined"), 5);
}

TEST_F(Doctor, ProgressIsShownUnlessQuiet) {
  const ProgramResult result = run_program({CPSLAM_DOCTOR_PATH, office_.path()});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("looking ["));
}

TEST_F(Doctor, WrongSettingsAreFound) {
  std::string yaml = TemporaryFolder::content(office_.settings());
  const std::size_t key = yaml.find("DepthMapFactor:");
  yaml.replace(key, yaml.find('\n', key) - key, "DepthMapFactor: 1000.0");
  office_.folder().write("office/settings.yaml", yaml);
  expect_error("depth scale", "DepthMapFactor 1000");
}

TEST_F(Doctor, SettingsOfAnotherCameraAreFound) {
  const ProgramResult result = examine({CPSLAM_SOURCE_DIR "/Examples/RGB-D/TUM1.yaml"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.out, HasSubstr("320x240"));
}

TEST_F(Doctor, MissingListIsAnError) {
  std::filesystem::remove(office_.file("depth.txt"));
  expect_error("image lists", "depth.txt");
}

TEST_F(Doctor, EmptyFolderIsFullOfErrors) {
  const ProgramResult result = run_program({CPSLAM_DOCTOR_PATH, office_.folder().path(), "--quiet"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.out, HasSubstr("rgb.txt"));
  EXPECT_THAT(result.out, HasSubstr("depth.txt"));
}

TEST_F(Doctor, DisorderInTheListIsAnError) {
  std::vector<std::string> lines = lines_of(TemporaryFolder::content(office_.file("rgb.txt")));
  std::swap(lines[lines.size() - 2], lines[lines.size() - 4]);
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  office_.folder().write("office/rgb.txt", text);
  expect_error("frame rate", "go back");
}

TEST_F(Doctor, MissingFilesAreAnError) {
  for (std::size_t i = 0; i < 4; ++i) std::filesystem::remove(office_.file(office_.colour(i)));
  expect_error("image lists", "4 of 12");
}

TEST_F(Doctor, TruncatedImagesAreAnError) {
  for (std::size_t i = 0; i < 3; ++i) std::filesystem::resize_file(office_.file(office_.depth(i)), 100);
  expect_error("images", "truncated");
}

TEST_F(Doctor, DepthOf8BitsIsAnError) {
  for (std::size_t i = 0; i < OfficeSequence::kFrames; ++i)
    cv::imwrite(office_.file(office_.depth(i)),
                cv::Mat(OfficeSequence::kHeight, OfficeSequence::kWidth, CV_8UC1, 90));
  expect_error("images", "16-bit");
}

TEST_F(Doctor, DepthWithoutReadingsIsAnError) {
  for (std::size_t i = 0; i < OfficeSequence::kFrames; ++i)
    cv::imwrite(office_.file(office_.depth(i)),
                cv::Mat::zeros(OfficeSequence::kHeight, OfficeSequence::kWidth, CV_16UC1));
  expect_error("valid depth", "0 %");
}

TEST_F(Doctor, GroundTruthOfAnotherClockIsAnError) {
  office_.folder().write("office/groundtruth.txt", "1.0 0 0 0 0 0 0 1\n1.1 0 0 0 0 0 0 1\n");
  expect_error("ground truth", "0.0 % of the frames");
}

TEST_F(Doctor, BadGroundTruthIsAWarning) {
  office_.folder().write("office/groundtruth.txt", "nonsense\n");
  const ProgramResult result = examine();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("groundtruth.txt:1"));
}

TEST_F(Doctor, WhatCannotBeLookedAtEndsWith1) {
  const auto expect_not_looked_at = [](const std::vector<std::string>& arguments, const std::string& word) {
    std::vector<std::string> command{CPSLAM_DOCTOR_PATH};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const ProgramResult result = run_program(command);
    EXPECT_EQ(result.exit_code, 1) << word;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
    EXPECT_THAT(result.err, HasSubstr(word));
  };
  expect_not_looked_at({}, "SEQUENCE");
  expect_not_looked_at({office_.file("nowhere")}, "not a folder");
  expect_not_looked_at({office_.path(), office_.file("nowhere.yaml")}, "nowhere.yaml");
  expect_not_looked_at({office_.path(), "--frames", "0"}, "--frames");
  expect_not_looked_at({office_.path(), "--camera"}, "one of them");
  expect_not_looked_at({office_.path(), "--json", "/nowhere/findings.json", "--quiet", "--nonsense"},
                       "nonsense");
}

TEST_F(Doctor, JsonThatCannotBeWrittenEndsWith1) {
  const ProgramResult result =
      run_program({CPSLAM_DOCTOR_PATH, office_.path(), "--quiet", "--json", "/nowhere/findings.json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("/nowhere/findings.json"));
}

TEST_F(Doctor, HelpNamesOptionsAndExitCodes) {
  const ProgramResult result = run_program({CPSLAM_DOCTOR_PATH, "--help"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* const word : {"SEQUENCE", "SETTINGS", "--camera", "--settings", "--resolution", "--frames",
                                 "--json", "--quiet", "--version", "Exit status: 0", "2 errors found"})
    EXPECT_THAT(result.out, HasSubstr(word));
  EXPECT_THAT(run_program({CPSLAM_DOCTOR_PATH, "--version"}).out, HasSubstr(CPSLAM_VERSION));
}

}  // namespace
}  // namespace cpslam
