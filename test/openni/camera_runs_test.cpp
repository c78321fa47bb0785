// Whole runs of rgbd_openni2 on a virtual camera that behaves.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "cpslam/settings.h"
#include "geometry/se3.h"
#include "io/trajectory_io.h"
#include "io/tum_sequence.h"
#include "openni/camera_office.h"

namespace cpslam {
namespace {

using test::CameraOffice;
using testing::HasSubstr;

void expect_counts_add_up(const nlohmann::json& stats) {
  std::size_t sum = 0;
  for (const char* const key : {"tracked", "predicted", "lost", "not_initialized", "unreadable", "dropped"})
    sum += stats.at(key).get<std::size_t>();
  EXPECT_EQ(stats.at("frames"), sum);
}

TEST(CameraRun, TracksWhatTheCameraSees) {
  const CameraOffice camera;
  const ProgramResult result = camera.run({"--max-frames", "60", "--auto-exposure", "off"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(count_lines(result.err, "warning"), 0U) << result.err;
  EXPECT_THAT(result.out, HasSubstr("Virtual Camera"));
  EXPECT_THAT(result.out, HasSubstr("latency"));
  const nlohmann::json stats = camera.stats();
  expect_counts_add_up(stats);
  EXPECT_EQ(stats.at("tracked"), 60);
  EXPECT_EQ(stats.at("interrupted"), false);
  EXPECT_EQ(stats.at("settings").at("realtime"), true);
  EXPECT_NEAR(stats.at("settings").at("camera").at("fx").get<double>(),
              load_settings(camera.office().settings()).camera.fx, 0.01)
      << "from the field of view";
  EXPECT_EQ(stats.at("settings").at("camera").at("depth_map_factor"), 1000.0);
  const nlohmann::json live = stats.at("live");
  EXPECT_GT(live.at("latency_ms").at("p50"), 0.0);
  EXPECT_LE(live.at("latency_ms").at("p50"), live.at("latency_ms").at("p95"));
  EXPECT_LE(live.at("latency_ms").at("p95"), live.at("latency_ms").at("max"));
  EXPECT_EQ(live.at("interruptions"), 0);
  EXPECT_EQ(live.at("clock_jumps"), 0);
  EXPECT_TRUE(live.at("recording").is_null());
  const Trajectory trajectory = camera.trajectory();
  EXPECT_EQ(trajectory.size(), 60U);
  expect_true(trajectory, camera);
}

TEST(CameraRun, EndsAfterItsDuration) {
  const CameraOffice camera;
  ASSERT_EQ(camera.run({"--duration", "1", "--quiet"}).exit_code, 0);
  const Trajectory trajectory = camera.trajectory();
  const double duration_s = trajectory.back().time_s - trajectory.front().time_s;
  EXPECT_GE(duration_s, 1.0 - 1e-5);
}

TEST(CameraRun, SettingsFileBeatsTheFieldOfView) {
  const CameraOffice camera;
  std::string yaml = TemporaryFolder::content(camera.office().settings());
  yaml.replace(yaml.find("Camera.cx"), yaml.find('\n', yaml.find("Camera.cx")) - yaml.find("Camera.cx"),
               "Camera.cx: 161.25");
  const std::string file = camera.folder().write("calibrated.yaml", yaml);
  const ProgramResult result = camera.run({file, "--max-frames", "3"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("1000 units a metre")) << "the file says 5000";
  const nlohmann::json settings = camera.stats().at("settings").at("camera");
  EXPECT_EQ(settings.at("cx"), 161.25);
  EXPECT_EQ(settings.at("depth_map_factor"), 1000.0);
}

TEST(CameraRun, WhatWasRecordedReplaysToTheSamePoses) {
  const CameraOffice camera;
  const std::string session = camera.folder().file("session");
  const ProgramResult result = camera.run({"--max-frames", "60", "--record", session});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json recording = camera.stats().at("live").at("recording");
  EXPECT_EQ(recording.at("frames").get<std::size_t>() + recording.at("dropped").get<std::size_t>(), 60U);
  EXPECT_EQ(recording.at("complete"), true);
  EXPECT_EQ(associate_sequence(session).size(), recording.at("frames").get<std::size_t>());
  const Trajectory live = camera.trajectory();

  const std::string output = camera.folder().file("replayed");
  const ProgramResult replay = run_rgbd_tum(
      {"-", session + "/settings.yaml", session, "--detector", "none", "--quiet", "--output", output});
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  const Trajectory replayed = read_trajectory(output + "/CameraTrajectory.txt");
  std::size_t compared = 0;
  for (const StampedPose& pose : replayed) {
    const auto same = std::find_if(live.begin(), live.end(), [&pose](const StampedPose& other) {
      return std::abs(other.time_s - pose.time_s) < 1e-5;
    });
    if (same == live.end()) continue;
    const SE3 apart = from_pose(pose.world_from_camera).inverse() * from_pose(same->world_from_camera);
    EXPECT_LT(apart.translation.norm(), 0.01) << pose.time_s;
    ++compared;
  }
  EXPECT_EQ(compared, recording.at("frames").get<std::size_t>());
}

TEST(CameraRun, AFullDiskEndsTheRecordingAlone) {
  const CameraOffice camera;
  const std::string session = camera.folder().file("session");
  // Room for 32 kB a file: for the trajectories, not for pictures.
  const ProgramResult result = camera.run_program_on_camera(
      {"/bin/sh", "-c", "trap '' XFSZ; ulimit -f 64; exec \"$0\" \"$@\"", RGBD_OPENNI2_PATH, "-",
       "--detector", "none", "--resolution", "320x240", "--max-frames", "40", "--record", session, "--output",
       camera.office().output()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(count_lines(result.err, "the recording ends here"), 1U) << result.err;
  EXPECT_THAT(result.out, HasSubstr("ended early"));
  EXPECT_EQ(camera.stats().at("tracked"), 40);
  EXPECT_EQ(camera.stats().at("live").at("recording").at("complete"), false);
}

TEST(CameraRun, RefusesToRecordOverSomething) {
  const CameraOffice camera;
  expect_refused(camera.run({"--quiet", "--record", camera.office().path()}),
                 {camera.office().path(), "not empty"});
}

TEST(OniFile, EveryFrameIsTrackedTheSameInEveryRun) {
  const CameraOffice camera;
  const std::string file = camera.record_oni(30);
  std::string first;
  for (int i = 0; i < 2; ++i) {
    const ProgramResult result = camera.run({"--device", file, "--sequential"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(camera.stats().at("dropped"), 0);
    EXPECT_GE(camera.stats().at("frames"), 25) << "OpenNI2's recorder may lose the last ones";
    EXPECT_EQ(camera.stats().at("tracked"), camera.stats().at("frames"));
    EXPECT_TRUE(camera.stats().at("live").at("latency_ms").is_null());
    const std::string trajectory = TemporaryFolder::content(camera.result("CameraTrajectory.txt"));
    if (i == 0) first = trajectory;
    EXPECT_EQ(trajectory, first);
  }
}

TEST(OniFile, PlaysAtItsRecordedSpeed) {
  const CameraOffice camera;
  const std::string file = camera.record_oni(30);
  const ProgramResult result = camera.run({"--device", file, "--realtime"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_counts_add_up(camera.stats());
  EXPECT_EQ(camera.stats().at("tracked"), camera.trajectory().size());
  EXPECT_GE(camera.stats().at("frames"), 20);
}

TEST(CameraCommandLine, HelpNamesEveryOption) {
  const ProgramResult result = run_program({RGBD_OPENNI2_PATH, "--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  for (const char* const word : {"VOCABULARY",
                                 "SETTINGS",
                                 "--device",
                                 "--list",
                                 "--resolution",
                                 "--fps",
                                 "--auto-exposure",
                                 "--duration",
                                 "--max-frames",
                                 "--stall-seconds",
                                 "--reconnect-seconds",
                                 "--record",
                                 "--output",
                                 "--detector",
                                 "--sequential",
                                 "--realtime",
                                 "--no-loop",
                                 "--seed",
                                 "--print-settings",
                                 "--quiet",
                                 "--version",
                                 "--boxes",
                                 "--model",
                                 "--boxes-policy",
                                 "--people-filter",
                                 "--save-boxes",
                                 "--draw",
                                 "--save-map",
                                 "--load-map"}) {
    EXPECT_THAT(result.out, HasSubstr(word));
  }
}

TEST(CameraCommandLine, ListsTheCameras) {
  const CameraOffice camera;
  const ProgramResult result = camera.run_program_on_camera({RGBD_OPENNI2_PATH, "--list"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "virtual://0  CP-SLAM Virtual Camera\n");
}

TEST(CameraCommandLine, BadOptionsAreNamed) {
  const auto with = [](const std::vector<std::string>& options) {
    std::vector<std::string> command{RGBD_OPENNI2_PATH, "-"};
    command.insert(command.end(), options.begin(), options.end());
    return run_program(command);
  };
  expect_refused(run_program({RGBD_OPENNI2_PATH}), {"VOCABULARY", "--help"});
  expect_refused(with({"--resolution", "640"}), {"--resolution", "640x480"});
  expect_refused(with({"--resolution", "640x480x3"}), {"--resolution", "640x480x3"});
  expect_refused(with({"--auto-exposure", "maybe"}), {"--auto-exposure", "on|off"});
  expect_refused(with({"--fps", "0"}), {"--fps"});
  expect_refused(with({"--max-frames", "0"}), {"--max-frames", "0"});
  expect_refused(with({"--sequential"}), {"--sequential", "file"});
}

}  // namespace
}  // namespace cpslam
