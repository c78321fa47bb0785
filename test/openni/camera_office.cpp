#include "openni/camera_office.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/se3.h"
#include "io/trajectory_io.h"

namespace cpslam::test {
namespace {

constexpr double kFps = 30.0;  // the simulator's

std::string resolution() {
  return std::to_string(OfficeSequence::kWidth) + "x" + std::to_string(OfficeSequence::kHeight);
}

}  // namespace

ProgramResult CameraOffice::run_program_on_camera(const std::vector<std::string>& command,
                                                  const std::string& faults,
                                                  const SignalAt& signal_at) const {
  std::string script = "sequence=" + office_.path();
  if (!faults.empty()) script += ";" + faults;
  std::vector<std::string> all{"/usr/bin/env", "LD_LIBRARY_PATH=" VIRTUAL_OPENNI2_PATH,
                               "CPSLAM_VIRTUAL_CAMERA=" + script};
  all.insert(all.end(), command.begin(), command.end());
  return run_program(all, signal_at);
}

ProgramResult CameraOffice::run(const std::vector<std::string>& arguments, const std::string& faults,
                                const SignalAt& signal_at) const {
  std::vector<std::string> command{RGBD_OPENNI2_PATH, "-", "--detector", "none"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  if (std::find(arguments.begin(), arguments.end(), "--resolution") == arguments.end())
    command.insert(command.end(), {"--resolution", resolution()});
  command.insert(command.end(), {"--output", office_.output()});
  return run_program_on_camera(command, faults, signal_at);
}

std::string CameraOffice::record_oni(int n_frames) const {
  const std::string file = folder().file("recording.oni");
  const ProgramResult result = run_program_on_camera({RECORD_ONI_PATH, file, std::to_string(n_frames)});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return file;
}

Pose CameraOffice::true_pose(double time_s) const {
  const Trajectory truth = read_trajectory(office_.file("groundtruth.txt"));
  const std::size_t last = truth.size() - 1;
  const auto n = static_cast<std::size_t>(std::lround((time_s - kStart_s) * kFps));
  // The camera plays forward and backward in turns.
  return truth[(n / last) % 2 == 0 ? n % last : last - n % last].world_from_camera;
}

void expect_true(const Trajectory& trajectory, const CameraOffice& camera) {
  ASSERT_FALSE(trajectory.empty());
  const SE3 first = from_pose(trajectory[0].world_from_camera);
  const SE3 true_first = from_pose(camera.true_pose(trajectory[0].time_s));
  for (const StampedPose& pose : trajectory) {
    const SE3 moved = first.inverse() * from_pose(pose.world_from_camera);
    const SE3 truly_moved = true_first.inverse() * from_pose(camera.true_pose(pose.time_s));
    const SE3 error = truly_moved.inverse() * moved;
    EXPECT_LT(error.translation.norm(), 0.02) << pose.time_s;
    EXPECT_LT(rotation_angle(error.rotation), std::numbers::pi / 180.0) << pose.time_s;
  }
}

}  // namespace cpslam::test
