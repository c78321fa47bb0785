#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "common/map_options.h"
#include "detector_options.h"

namespace cpslam::program {

/// The command line of rgbd_tum.
struct RgbdTumOptions {
  std::string vocabulary;
  std::string settings;
  std::string sequence;
  std::string associations;  ///< empty: rgb.txt and depth.txt are associated
  std::string output = ".";
  bool sequential = false;
  bool no_loop = false;
  bool realtime = false;
  bool print_settings = false;
  bool quiet = false;
  std::size_t start = 0;
  std::optional<std::size_t> max_frames;
  std::uint64_t seed = 0;
  DetectorOptions detector;
  MapOptions maps;
};

/// Parses the command line. When the program has nothing more to do (--help, --version, bad usage), prints
/// what there is to say and sets exit_code.
[[nodiscard]] RgbdTumOptions parse_command_line(int argc, char** argv, std::optional<int>& exit_code);

}  // namespace cpslam::program
