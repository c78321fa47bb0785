// Images that rgbd_tum cannot use cost their frame and not the run.
#include <gmock/gmock.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "programs/office_sequence.h"

namespace cpslam {
namespace {

using testing::HasSubstr;

constexpr std::size_t kBad = 5;
constexpr std::size_t kSecond = 30;  // frames

cv::Mat flat_image(int type, double value) {
  return {OfficeSequence::kHeight, OfficeSequence::kWidth, type, cv::Scalar::all(value)};
}

class BadImages : public testing::Test {
 protected:
  /// Expects that all frames but one were tracked and that a warning names the file and has the word.
  void expect_one_frame_left_out(const std::string& file, const std::string& word) const {
    const ProgramResult result = office_.track({"--quiet"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
    EXPECT_THAT(result.err, HasSubstr("warning: "));
    EXPECT_THAT(result.err, HasSubstr(file));
    EXPECT_THAT(result.err, HasSubstr(word));
    const Trajectory trajectory = office_.trajectory();
    ASSERT_EQ(trajectory.size(), OfficeSequence::kFrames - 1);
    for (const StampedPose& pose : trajectory) EXPECT_GT(std::abs(pose.time_s - office_.time_s(kBad)), 0.01);
    const nlohmann::json stats = office_.stats();
    EXPECT_EQ(stats["unreadable"], 1U);
    EXPECT_EQ(stats["tracked"], OfficeSequence::kFrames - 1);
    EXPECT_EQ(stats["frames"], OfficeSequence::kFrames);
    EXPECT_LT(stats["ate"]["rmse_m"], 0.01);
  }
  /// Expects that no frame could be used, and a line that says so.
  void expect_none_used(const std::string& word) const {
    const ProgramResult result = office_.track({"--quiet"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.ended_by, 0);
    EXPECT_THAT(result.err, HasSubstr(word));
    EXPECT_THAT(lines_of(result.err).back(), HasSubstr("none of its 12 frames"));
    // Of the same complaint ten times is enough; the eleventh says that there are more.
    EXPECT_EQ(count_lines(result.err, word), 10U) << result.err;
    EXPECT_EQ(office_.stats()["unreadable"], OfficeSequence::kFrames);
  }
  void cut_in_half(const std::string& path) const {
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  }
  /// The sequence, then a second of this pair, then the sequence back.
  [[nodiscard]] nlohmann::json stats_with_a_second_of(const std::pair<std::string, std::string>& pair) const {
    auto pairs = office_.pairs();
    pairs.insert(pairs.end(), kSecond, pair);
    const auto back = office_.pairs(true);
    pairs.insert(pairs.end(), back.begin(), back.end());
    std::filesystem::remove(office_.file("groundtruth.txt"));
    const ProgramResult result = office_.track({office_.associations(pairs)});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const Trajectory trajectory = office_.trajectory();
    EXPECT_EQ(office_.stats()["frames"], pairs.size());
    // The last frame is the first one again, and stands where that stood.
    if (trajectory.empty()) {
      ADD_FAILURE() << "nothing was tracked";
      return {};
    }
    EXPECT_NEAR(trajectory.back().time_s, 1000.0 + static_cast<double>(pairs.size() - 1) / 30.0, 1e-5);
    for (const double offset_m : trajectory.back().world_from_camera.translation_m)
      EXPECT_NEAR(offset_m, 0.0, 0.01);
    return office_.stats();
  }
  std::string write_image(const std::string& name, const cv::Mat& image) const {
    cv::imwrite(office_.file(name), image);
    return name;
  }

  OfficeSequence office_;
};

TEST_F(BadImages, MissingColour) {
  std::filesystem::remove(office_.file(office_.colour(kBad)));
  expect_one_frame_left_out(office_.colour(kBad), "No such file");
}

TEST_F(BadImages, MissingDepth) {
  std::filesystem::remove(office_.file(office_.depth(kBad)));
  expect_one_frame_left_out(office_.depth(kBad), "No such file");
}

TEST_F(BadImages, TruncatedColour) {
  cut_in_half(office_.file(office_.colour(kBad)));
  expect_one_frame_left_out(office_.colour(kBad), "truncated");
}

TEST_F(BadImages, TruncatedDepth) {
  cut_in_half(office_.file(office_.depth(kBad)));
  expect_one_frame_left_out(office_.depth(kBad), "truncated");
}

TEST_F(BadImages, NotAnImage) {
  office_.folder().write("office/" + office_.colour(kBad), "<html>404</html>");
  expect_one_frame_left_out(office_.colour(kBad), "not a PNG");
}

TEST_F(BadImages, DepthOfAnotherSize) {
  const cv::Mat depth = cv::imread(office_.file(office_.depth(kBad)), cv::IMREAD_UNCHANGED);
  cv::Mat smaller;
  cv::resize(depth, smaller, cv::Size(160, 120), 0.0, 0.0, cv::INTER_NEAREST);
  write_image(office_.depth(kBad), smaller);
  expect_one_frame_left_out(office_.depth(kBad), "registered");
}

TEST_F(BadImages, DepthOfAnotherTypeInOneFrame) {
  write_image(office_.depth(kBad), flat_image(CV_8UC1, 90.0));
  expect_one_frame_left_out(office_.depth(kBad), "16-bit");
}

TEST_F(BadImages, DepthOfAnotherTypeInAllFrames) {
  for (std::size_t i = 0; i < OfficeSequence::kFrames; ++i) {
    write_image(office_.depth(i), flat_image(CV_8UC1, 90.0));
  }
  expect_none_used("16-bit");
}

TEST_F(BadImages, SettingsOfAnotherImageSize) {
  office_.folder().write("office/settings.yaml",
                         TemporaryFolder::content(CPSLAM_SOURCE_DIR "/Examples/RGB-D/TUM1.yaml"));
  expect_none_used("Camera.width");
}

TEST_F(BadImages, BlackForASecond) {
  const std::string black = write_image("black.png", flat_image(CV_8UC3, 0.0));
  const nlohmann::json stats = stats_with_a_second_of({black, office_.depth(OfficeSequence::kFrames - 1)});
  EXPECT_EQ(stats["tracked"], 2 * OfficeSequence::kFrames);
  EXPECT_EQ(stats["predicted"].get<std::size_t>() + stats["lost"].get<std::size_t>(), kSecond);
  EXPECT_GT(stats["lost"], 0);
}

TEST_F(BadImages, NoDepthForASecond) {
  const std::string none = write_image("no_depth.png", flat_image(CV_16UC1, 0.0));
  const nlohmann::json stats = stats_with_a_second_of({office_.colour(OfficeSequence::kFrames - 1), none});
  // The map is known by then: its points are found without depth.
  EXPECT_EQ(stats["tracked"], 2 * OfficeSequence::kFrames + kSecond);
}

TEST_F(BadImages, NothingToSeeAtTheStart) {
  const std::string black = write_image("black.png", flat_image(CV_8UC3, 0.0));
  auto pairs = office_.pairs();
  pairs.insert(pairs.begin(), 4, {black, office_.depth(0)});
  std::filesystem::remove(office_.file("groundtruth.txt"));
  const ProgramResult result = office_.track({office_.associations(pairs)});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(office_.stats()["not_initialized"], 4);
  EXPECT_EQ(office_.stats()["tracked"], OfficeSequence::kFrames);
}

TEST_F(BadImages, NothingToSeeAtAll) {
  const std::string black = write_image("black.png", flat_image(CV_8UC3, 0.0));
  const std::string none = write_image("no_depth.png", flat_image(CV_16UC1, 0.0));
  const std::vector<std::pair<std::string, std::string>> pairs(5, {black, none});
  const ProgramResult result = office_.track({office_.associations(pairs), "--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("no valid reading"));
  EXPECT_EQ(office_.stats()["not_initialized"], 5);
  EXPECT_EQ(TemporaryFolder::content(office_.result("CameraTrajectory.txt")), "");
}

TEST_F(BadImages, ImplausibleDepthFactorIsNamed) {
  std::string text = TemporaryFolder::content(office_.settings());
  const std::size_t key = text.find("DepthMapFactor:");
  ASSERT_NE(key, std::string::npos);
  text.replace(key, text.find('\n', key) - key, "DepthMapFactor: 100.0");
  office_.folder().write("office/settings.yaml", text);
  const ProgramResult result = office_.track({"--quiet", "--max-frames", "2"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(count_lines(result.err, "DepthMapFactor"), 1U) << result.err;
}

}  // namespace
}  // namespace cpslam
