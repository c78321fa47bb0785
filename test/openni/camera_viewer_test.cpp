// rgbd_openni2 --viewer on the virtual camera and a virtual display.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "io/trajectory_io.h"
#include "openni/camera_office.h"
#include "support/virtual_display.h"
#include "support/window_user.h"

namespace cpslam {
namespace {

using test::CameraOffice;
using test::VirtualDisplay;
using test::WindowUser;
using testing::HasSubstr;

class CameraViewer : public testing::Test {
 protected:
  void SetUp() override {
    if (!display.running()) GTEST_SKIP() << VirtualDisplay::kMissing;
    std::filesystem::create_directories(camera.office().output());
  }

  /// Presses S until the picture of a frame after this one is there; that frame's number.
  [[nodiscard]] int wait_for_frame_after(const WindowUser& window, int frame) const {
    int newest = -1;
    while (newest <= frame) {
      window.press("s");
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      for (const auto& entry : std::filesystem::directory_iterator(camera.office().output())) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("viewer-") && name.ends_with(".png"))
          newest = std::max(newest, std::stoi(name.substr(7, 6)));
      }
    }
    return newest;
  }

  VirtualDisplay display;
  CameraOffice camera;
};

TEST_F(CameraViewer, AWholeRunEndsWithItsPictureAndResults) {
  const std::string picture_path = camera.folder().file("window.png");
  const ProgramResult result =
      camera.run({"--max-frames", "45", "--viewer", "--viewer-screenshot", picture_path});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json stats = camera.stats();
  EXPECT_EQ(stats.at("interrupted"), false);
  EXPECT_EQ(stats.at("tracked"), 45);
  EXPECT_EQ(camera.trajectory().size(), 45U);
  expect_true(camera.trajectory(), camera);
  const cv::Mat picture = cv::imread(picture_path);
  ASSERT_EQ(picture.size(), cv::Size(1600, 900));
  cv::Scalar mean, deviation;
  cv::meanStdDev(picture(cv::Rect(20, 60, 600, 420)), mean, deviation);
  EXPECT_GT(deviation[0], 15.0) << "the camera's image";
}

TEST_F(CameraViewer, ClosingTheWindowEndsTheRunWithItsResults) {
  std::jthread user([&] {
    const WindowUser window("CP-SLAM");
    (void)wait_for_frame_after(window, 5);
    window.close();
  });
  // The camera goes on for ever.
  const ProgramResult result = camera.run({"--viewer"});
  user.join();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(count_lines(result.err, "error"), 0U) << result.err;
  EXPECT_EQ(camera.stats().at("interrupted"), true);
  EXPECT_GT(camera.trajectory().size(), 5U);
  EXPECT_FALSE(read_trajectory(camera.result("KeyFrameTrajectory.txt")).empty());
}

TEST_F(CameraViewer, TheMapIsDroppedAndMappingSwitchedOffWithoutLosingAFrame) {
  int reset_at = -1;
  std::jthread user([&] {
    const WindowUser window("CP-SLAM");
    reset_at = wait_for_frame_after(window, 10);
    window.press("r");
    window.press("r");
    const int mapped = wait_for_frame_after(window, reset_at + 10);
    window.press("l");
    (void)wait_for_frame_after(window, mapped + 20);
    window.close();
  });
  const ProgramResult result = camera.run({"--viewer"});
  user.join();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("map dropped"));
  EXPECT_THAT(result.err, HasSubstr("localisation: the map stays as it is"));
  const nlohmann::json stats = camera.stats();
  EXPECT_EQ(stats.at("dropped_maps"), 1);
  const Trajectory before = read_trajectory(camera.result("CameraTrajectory_dropped1.txt"));
  const Trajectory after = camera.trajectory();
  EXPECT_FALSE(read_trajectory(camera.result("KeyFrameTrajectory_dropped1.txt")).empty());
  EXPECT_EQ(before.size() + after.size(), stats.at("tracked"));
  ASSERT_GE(before.size(), static_cast<std::size_t>(reset_at));
  ASSERT_GT(after.size(), 20U);
  EXPECT_GT(after.front().time_s, before.back().time_s);
  expect_true(before, camera);
  expect_true(after, camera);
}

}  // namespace
}  // namespace cpslam
