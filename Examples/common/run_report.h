#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "common/dense_report.h"
#include "common/live_report.h"
#include "cpslam/settings.h"
#include "cpslam/types.h"
#include "io/trajectory_error.h"

namespace cpslam::program {

/// What a run leaves behind besides its trajectories.
struct RunReport {
  std::string version;
  std::string sequence;  ///< or the camera
  Settings settings;
  Statistics statistics;
  std::size_t frames_in_sequence = 0;
  std::size_t unreadable = 0;  ///< frames with a bad file or refused by track()
  std::size_t dropped = 0;     ///< left out to keep up with real time
  bool interrupted = false;
  double sequence_s = 0.0;  ///< from the first frame to the last that was read, in their stamps
  double wall_s = 0.0;
  double peak_memory_mb = 0.0;
  std::optional<TrajectoryError> ate;
  std::optional<DenseReport> dense;  ///< when one was asked for and could be made
  std::optional<LiveReport> live;    ///< of a camera's run
};

/// Resident memory of this process at its highest, MB.
[[nodiscard]] double peak_memory_mb();

[[nodiscard]] std::string to_json(const RunReport& report);
[[nodiscard]] std::string to_text(const RunReport& report);

}  // namespace cpslam::program
