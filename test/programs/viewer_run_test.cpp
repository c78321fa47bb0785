// rgbd_tum --viewer on a virtual display.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "programs/office_sequence.h"
#include "support/virtual_display.h"
#include "support/window_user.h"

namespace cpslam {
namespace {

using test::VirtualDisplay;
using test::WindowUser;
using testing::HasSubstr;

class ViewerRun : public testing::Test {
 protected:
  void SetUp() override {
    if (!display.running()) GTEST_SKIP() << VirtualDisplay::kMissing;
  }
  VirtualDisplay display;
};

/// How much a picture varies, grey levels.
double spread(const cv::Mat& picture) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(picture, mean, deviation);
  return std::max({deviation[0], deviation[1], deviation[2]});
}

TEST_F(ViewerRun, TheTrajectoryIsTheSameByteForByteAndThePictureIsThere) {
  const OfficeSequence office("walking_xyz", 2.0);
  const std::vector<std::string> how{"--sequential", "--boxes", office.file("person_boxes.txt")};
  ASSERT_EQ(office.track(how).exit_code, 0);
  const std::string alone = TemporaryFolder::content(office.result("CameraTrajectory.txt"));
  const std::string keyframes_alone = TemporaryFolder::content(office.result("KeyFrameTrajectory.txt"));
  std::vector<std::string> viewed = how;
  const std::string picture_path = office.folder().file("window.png");
  viewed.insert(viewed.end(), {"--viewer", "--viewer-screenshot", picture_path});
  const ProgramResult result = office.track(viewed);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(TemporaryFolder::content(office.result("CameraTrajectory.txt")), alone);
  EXPECT_EQ(TemporaryFolder::content(office.result("KeyFrameTrajectory.txt")), keyframes_alone);
  EXPECT_EQ(office.stats().at("interrupted"), false) << "the window closes by itself, after the end";
  const cv::Mat picture = cv::imread(picture_path);
  ASSERT_EQ(picture.size(), cv::Size(1600, 900));
  EXPECT_GT(spread(picture(cv::Rect(20, 60, 600, 420))), 15.0) << "the camera's image";
  EXPECT_GT(spread(picture(cv::Rect(700, 150, 600, 600))), 5.0) << "the map";
}

/// The frame that the newest screenshot in a folder shows; -1 when there is none.
int newest_screenshot(const std::string& folder) {
  int newest = -1;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("viewer-") && name.ends_with(".png"))
      newest = std::max(newest, std::stoi(name.substr(7, 6)));
  }
  return newest;
}

TEST_F(ViewerRun, ClosingTheWindowInTheMiddleSavesWhatWasTracked) {
  const OfficeSequence office;
  std::vector<std::pair<std::string, std::string>> there_and_back;
  for (int lap = 0; lap < 600; ++lap) {
    for (const auto& pair : office.pairs(lap % 2 == 1)) there_and_back.push_back(pair);
  }
  std::filesystem::create_directories(office.output());
  std::jthread user([&] {
    const WindowUser window("CP-SLAM");
    while (newest_screenshot(office.output()) < 1) {
      window.press("s");
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    window.close();
  });
  // At thirty frames a second it would take four minutes: no machine is so slow that the user comes too late.
  const ProgramResult result =
      office.track({office.associations(there_and_back), "--realtime", "--no-loop", "--viewer"});
  user.join();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(office.stats().at("interrupted"), true);
  EXPECT_GT(office.trajectory().size(), 0U);
  EXPECT_LT(office.trajectory().size(), there_and_back.size());
}

TEST_F(ViewerRun, CtrlCClosesTheWindow) {
  const OfficeSequence office;
  const ProgramResult result = office.track({"--viewer"}, {SIGINT, "100 %"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.ended_by, 0);
  EXPECT_EQ(office.trajectory().size(), OfficeSequence::kFrames);
}

TEST(ViewerRunWithoutDisplay, SaysSoBeforeAnythingIsTracked) {
  unsetenv("DISPLAY");
  const OfficeSequence office;
  const ProgramResult result = office.track({"--viewer", "--quiet"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("display"));
  EXPECT_FALSE(std::filesystem::exists(office.result("stats.json")));
}

}  // namespace
}  // namespace cpslam
