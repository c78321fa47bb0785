#pragma once

#include <functional>
#include <string>

#include "sim/simulation.h"

namespace cpslam::sim {

struct WriteOptions {
  bool jpeg = false;   ///< colour as JPEG of quality 93 instead of PNG
  bool masks = false;  ///< also masks/ and masks.txt
  bool force = false;  ///< write into a directory that is not empty
  /// Called after every frame; false ends the sequence there.
  std::function<bool(int done, int total)> on_progress;
};

/// Writes a sequence in TUM layout: rgb/, depth/ (16-bit PNG), rgb.txt, depth.txt, groundtruth.txt,
/// settings.yaml, person_boxes.txt. The lists come last, so that what a crash or a full disk cut short does
/// not look whole. Throws InputError for a directory that is not empty, RunError for a file that cannot be
/// written.
void write_sequence(Simulation& simulation, const std::string& directory, const WriteOptions& options);

}  // namespace cpslam::sim
