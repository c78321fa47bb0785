#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace cpslam::program {

/// The command line of cpslam_doctor.
struct DoctorOptions {
  std::string sequence;               ///< folder; empty with --camera
  std::string settings;               ///< file; empty: the sequence's settings.yaml, if it has one
  std::optional<std::string> camera;  ///< name, URI or .oni file; an empty text: the first camera
  int width = 640;                    ///< of the camera's images, px
  int height = 480;
  std::size_t n_frames = 300;  ///< to look at
  std::string json;            ///< file; empty: none
  bool quiet = false;
};

/// Parses the command line. When the program has nothing more to do (--help, bad usage), prints what there is
/// to say and sets exit_code.
[[nodiscard]] DoctorOptions parse_command_line(int argc, char** argv, std::optional<int>& exit_code);

}  // namespace cpslam::program
