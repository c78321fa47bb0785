#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "common/slam_options.h"
#include "openni/rgbd_camera.h"

namespace cpslam::program {

/// The command line of rgbd_openni2.
struct RgbdOpenni2Options {
  CameraOptions camera;
  std::optional<std::size_t> max_frames;
  std::optional<double> duration_s;
  double stall_s = 5.0;       ///< without a frame: the camera counts as gone
  double reconnect_s = 30.0;  ///< how long to wait for a camera that is gone
  std::string record;         ///< folder; empty: nothing is recorded
  SlamOptions slam;
};

/// Parses the command line. When the program has nothing more to do (--help, --list, bad usage), prints what
/// there is to say and sets exit_code.
[[nodiscard]] RgbdOpenni2Options parse_command_line(int argc, char** argv, std::optional<int>& exit_code);

}  // namespace cpslam::program
