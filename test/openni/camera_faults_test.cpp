// What rgbd_openni2 does when the camera does not behave.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "openni/camera_office.h"

namespace cpslam {
namespace {

using test::CameraOffice;

void expect_growing(const Trajectory& trajectory) {
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    ASSERT_GT(trajectory[i].time_s, trajectory[i - 1].time_s) << i;
}

TEST(CameraFault, UnpluggedForGood) {
  const CameraOffice camera;
  const ProgramResult result = camera.run({"--reconnect-seconds", "0.3"}, "unplug-after=30");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.ended_by, 0);
  EXPECT_EQ(count_lines(result.err, "is unplugged; saving what was tracked"), 1U) << result.err;
  EXPECT_EQ(count_lines(result.err, "has not come back within 0.3 s"), 1U) << result.err;
  const nlohmann::json stats = camera.stats();
  EXPECT_EQ(stats.at("live").at("interruptions"), 1);
  EXPECT_EQ(stats.at("live").at("reconnects"), 0);
  EXPECT_EQ(stats.at("tracked"), camera.trajectory().size());
  // The last picture may go down with the camera.
  EXPECT_GE(stats.at("frames"), 25);
  expect_true(camera.trajectory(), camera);
}

TEST(CameraFault, NobodyWaitsWhoDoesNotWantTo) {
  const CameraOffice camera;
  const ProgramResult result = camera.run({"--reconnect-seconds", "0", "--quiet"}, "unplug-after=10");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(count_lines(result.err, "is unplugged"), 1U) << result.err;
  EXPECT_GT(camera.trajectory().size(), 0U);
}

TEST(CameraFault, TheMapIsSavedWhenTheCameraIsGone) {
  const CameraOffice camera;
  const std::string map = camera.folder().file("office.map");
  ASSERT_EQ(
      camera.run({"--reconnect-seconds", "0", "--quiet", "--save-map", map}, "unplug-after=20").exit_code, 1);
  const ProgramResult again = camera.run({"--max-frames", "20", "--load-map", map});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_GT(camera.stats().at("tracked"), 0) << "it is recognised";
}

TEST(CameraFault, UnpluggedAndPluggedInAgain) {
  const CameraOffice camera;
  // Its clock begins anew.
  const ProgramResult result =
      camera.run({"--max-frames", "60"}, "unplug-after=30;return-after=0.5;start-us=500000000");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(count_lines(result.err, "the camera is back"), 1U) << result.err;
  const nlohmann::json stats = camera.stats();
  EXPECT_EQ(stats.at("live").at("interruptions"), 1);
  EXPECT_EQ(stats.at("live").at("reconnects"), 1);
  EXPECT_EQ(stats.at("live").at("clock_jumps"), 0);
  EXPECT_EQ(stats.at("tracked"), 60) << "it is in the map where it was";
  const Trajectory trajectory = camera.trajectory();
  expect_growing(trajectory);
  EXPECT_GT(trajectory.back().time_s - trajectory.front().time_s, 2.0) << "with the time it was away";
}

TEST(CameraFault, SilentCamerasAreOpenedAnew) {
  const CameraOffice camera;
  const ProgramResult result = camera.run({"--max-frames", "50", "--stall-seconds", "1"}, "stall-after=25");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GE(count_lines(result.err, "has delivered nothing for 1.0 s"), 1U) << result.err;
  EXPECT_GE(camera.stats().at("live").at("reconnects"), 1);
  EXPECT_EQ(camera.stats().at("tracked"), 50);
  expect_growing(camera.trajectory());
}

TEST(CameraFault, NobodyWaitsForeverForACameraThatOpensAndIsSilent) {
  const CameraOffice camera;
  const ProgramResult result =
      camera.run({"--stall-seconds", "0.5", "--reconnect-seconds", "0.8"}, "die-after=25");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(count_lines(result.err, "has delivered nothing for 0.5 s"), 1U) << result.err;
  EXPECT_EQ(count_lines(result.err, "has not come back within 0.8 s"), 1U) << result.err;
  EXPECT_EQ(camera.stats().at("live").at("reconnects"), 0);
  EXPECT_GT(camera.trajectory().size(), 0U);
}

TEST(CameraFault, CtrlCEndsTheWaitForASilentCamera) {
  const CameraOffice camera;
  const ProgramResult result =
      camera.run({"--stall-seconds", "3600"}, "stall-after=20", {SIGINT, "map 1 started"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(camera.stats().at("interrupted"), true);
  EXPECT_GT(camera.trajectory().size(), 0U);
}

TEST(CameraFault, CtrlCEndsTheWaitForAnUnpluggedCamera) {
  const CameraOffice camera;
  const ProgramResult result =
      camera.run({"--reconnect-seconds", "3600"}, "unplug-after=20", {SIGINT, "is unplugged"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(camera.stats().at("interrupted"), true);
  EXPECT_GT(camera.trajectory().size(), 0U);
}

TEST(CameraFault, ClocksThatJumpAreToldAndBridged) {
  for (const std::string& jump : {std::string("-800000"), std::string("500000000")}) {
    const CameraOffice camera;
    const ProgramResult result = camera.run({"--max-frames", "60"}, "jump-after=25;jump-us=" + jump);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(count_lines(result.err, "the camera's clock jumped by"), 1U) << result.err;
    EXPECT_EQ(camera.stats().at("live").at("clock_jumps"), 1);
    EXPECT_EQ(camera.stats().at("tracked"), 60);
    const Trajectory trajectory = camera.trajectory();
    expect_growing(trajectory);
    EXPECT_LT(trajectory.back().time_s - trajectory.front().time_s, 300.0);
  }
}

TEST(CameraFault, WrongResolutionIsRefusedWithWhatThereIs) {
  const CameraOffice camera;
  expect_refused(camera.run({"--quiet", "--resolution", "640x480"}),
                 {"640x480 at 30/s", "320x240 at 30/s", "--resolution"});
  expect_refused(camera.run({"--quiet", "--fps", "60"}), {"320x240 at 60/s", "320x240 at 30/s", "--fps"});
  EXPECT_FALSE(std::filesystem::exists(camera.result("stats.json")));
}

TEST(CameraFault, SettingsOfAnotherSizeAreRefused) {
  const CameraOffice camera;
  const std::string file = std::string(CPSLAM_SOURCE_DIR) + "/Examples/RGB-D/TUM1.yaml";
  expect_refused(camera.run({file, "--quiet"}), {file, "640x480", "320x240"});
}

TEST(CameraFault, NoRegistrationIsRefusedForCamerasAndAcceptedForFiles) {
  const CameraOffice camera;
  expect_refused(camera.run({"--quiet"}, "registration=no"), {"Virtual Camera", "register depth to colour"});
  const std::string file = camera.record_oni(5);
  EXPECT_EQ(camera.run({"--quiet", "--device", file}, "registration=no").exit_code, 0);
}

TEST(CameraFault, CamerasThatAreNotThere) {
  const CameraOffice camera;
  expect_refused(camera.run({"--quiet", "--device", "Kinect"}), {"--device Kinect", "virtual://0"});
  expect_refused(
      run_program({"/usr/bin/env", "LD_LIBRARY_PATH=" VIRTUAL_OPENNI2_PATH, RGBD_OPENNI2_PATH, "-"}),
      {"no camera"});
}

TEST(CameraFault, AFileThatIsNoRecording) {
  const CameraOffice camera;
  const std::string file = camera.folder().write("broken.oni", std::string(1000, 'x'));
  expect_refused(camera.run({"--quiet", "--device", file}), {"broken.oni", "no recording"});
}

}  // namespace
}  // namespace cpslam
