#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "common/slam_options.h"

namespace cpslam::program {

/// The command line of rgbd_tum.
struct RgbdTumOptions {
  std::string sequence;
  std::string associations;  ///< empty: rgb.txt and depth.txt are associated
  std::size_t start = 0;
  std::optional<std::size_t> max_frames;
  SlamOptions slam;
};

/// Parses the command line. When the program has nothing more to do (--help, --version, bad usage), prints
/// what there is to say and sets exit_code.
[[nodiscard]] RgbdTumOptions parse_command_line(int argc, char** argv, std::optional<int>& exit_code);

}  // namespace cpslam::program
