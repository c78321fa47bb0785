// The pictures that rgbd_tum --draw writes.
#include <gmock/gmock.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "programs/office_sequence.h"

namespace cpslam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Pixels that are of one colour far more than of the others.
int count_pure(const cv::Mat& picture, int channel) {
  int n = 0;
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const auto& pixel = picture.at<cv::Vec3b>(y, x);
      const int other = std::max(pixel[(channel + 1) % 3], pixel[(channel + 2) % 3]);
      if (pixel[channel] > 180 && other < 110) ++n;
    }
  }
  return n;
}
constexpr int kGreen = 1, kRed = 2;

std::string picture_name(double time_s) {
  char name[40];
  std::snprintf(name, sizeof name, "%.6f.jpg", time_s);
  return name;
}

std::set<std::string> names_in(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

std::set<std::string> expected_names(const OfficeSequence& sequence, std::size_t n_frames) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < n_frames; ++i) names.insert(picture_name(sequence.time_s(i)));
  return names;
}

TEST(Pictures, ShowKeptAndRemovedKeypoints) {
  const OfficeSequence crowd("walking_xyz", 2.0);
  const std::string folder = crowd.folder().file("deep/pictures");
  const ProgramResult result = crowd.track({"--boxes", crowd.file("person_boxes.txt"), "--people-filter",
                                            "boxes", "--no-reinstate", "--draw", folder});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr(folder));
  EXPECT_EQ(names_in(folder), expected_names(crowd, OfficeSequence::kFrames));
  int red = 0;
  for (std::size_t i = 0; i < OfficeSequence::kFrames; ++i) {
    const cv::Mat picture = cv::imread(folder + "/" + picture_name(crowd.time_s(i)), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(picture.size(), cv::Size(OfficeSequence::kWidth, OfficeSequence::kHeight));
    ASSERT_EQ(picture.type(), CV_8UC3);
    const cv::Mat colour = cv::imread(crowd.file(crowd.colour(i)));
    EXPECT_GT(count_pure(picture, kGreen), count_pure(colour, kGreen) + 200) << i;
    red += count_pure(picture, kRed) - count_pure(colour, kRed);
  }
  EXPECT_GT(red, 100);
}

TEST(Pictures, AreDrawnWithoutADetectorToo) {
  const OfficeSequence office;
  const std::string folder = office.folder().file("pictures");
  EXPECT_EQ(office.track({"--quiet", "--draw", folder, "--max-frames", "3"}).exit_code, 0);
  EXPECT_EQ(names_in(folder), expected_names(office, 3));
}

TEST(Pictures, DoNotChangeTheResult) {
  const OfficeSequence office;
  ASSERT_EQ(office.track({"--quiet", "--sequential"}).exit_code, 0);
  const std::string without = TemporaryFolder::content(office.result("CameraTrajectory.txt"));
  ASSERT_EQ(office.track({"--quiet", "--sequential", "--draw", office.folder().file("pictures")}).exit_code,
            0);
  EXPECT_EQ(TemporaryFolder::content(office.result("CameraTrajectory.txt")), without);
}

TEST(Pictures, AFullDiskEndsTheDrawingAndNotTheRun) {
  const OfficeSequence office;
  const std::string folder = office.folder().file("pictures");
  fs::create_directories(folder);
  fs::create_symlink("/dev/full", folder + "/" + picture_name(office.time_s(3)));
  const ProgramResult result = office.track({"--quiet", "--draw", folder});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
  EXPECT_THAT(result.err, testing::AllOf(HasSubstr("warning: "), HasSubstr(picture_name(office.time_s(3))),
                                         HasSubstr("No space left"), HasSubstr("no more pictures")));
  EXPECT_EQ(names_in(folder), expected_names(office, 4));  // the link among them
  EXPECT_EQ(office.trajectory().size(), OfficeSequence::kFrames);
}

TEST(Pictures, AFolderThatCannotBeMadeIsNamed) {
  const OfficeSequence office;
  expect_refused(office.track({"--quiet", "--draw", "/proc/no_such_folder"}),
                 {"--draw", "/proc/no_such_folder"});
  expect_refused(office.track({"--quiet", "--draw", office.settings()}), {"--draw", office.settings()});
}

}  // namespace
}  // namespace cpslam
