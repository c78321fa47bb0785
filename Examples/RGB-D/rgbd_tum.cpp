// rgbd_tum: tracks an RGB-D sequence in TUM format.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "common/run_program.h"
#include "common/slam_session.h"
#include "common/stop_signal.h"
#include "common/viewer_session.h"
#include "cpslam/error.h"
#include "io/tum_sequence.h"
#include "rgbd_tum_options.h"
#include "run_sequence.h"

namespace cpslam::program {
namespace {

std::vector<RgbdEntry> select_entries(const RgbdTumOptions& options) {
  std::vector<RgbdEntry> entries = options.associations.empty()
                                       ? associate_sequence(options.sequence)
                                       : read_associations(options.sequence, options.associations);
  if (options.start >= entries.size()) {
    throw InputError("--start " + std::to_string(options.start) + ": the sequence has only " +
                     std::to_string(entries.size()) + " colour-depth pairs");
  }
  entries.erase(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(options.start));
  if (options.max_frames) entries.resize(std::min(entries.size(), *options.max_frames));
  return entries;
}

int main_program(const RgbdTumOptions& options) {
  RunReport report;
  report.version = CPSLAM_VERSION;
  report.sequence = options.sequence;
  report.settings = load_settings(options.slam.settings);
  apply(options.slam, report.settings);
  if (options.slam.print_settings) std::cout << to_yaml(report.settings) << std::flush;
  note_missing_detector(options.slam);
  const std::vector<RgbdEntry> entries = select_entries(options);
  report.frames_in_sequence = entries.size();

  ProgressBar bar("tracking", entries.size(), !options.slam.quiet);
  SlamSession session(options.slam, report.settings, bar);
  install_stop_signal();
  const std::string ground_truth = (std::filesystem::path(options.sequence) / "groundtruth.txt").string();
  RunControl control;
  const auto work = [&] {
    const int run_code = run_sequence(session, entries, control, bar, report);
    return std::max(run_code, session.finish(ground_truth, report));
  };
  const int exit_code =
      run_beside_viewer(options.slam, {report.settings, ground_truth}, session, control, work);
  if (report.statistics.frames == 0 && !report.interrupted) {
    throw InputError(options.sequence + ": none of its " + std::to_string(entries.size()) +
                     " frames could be used");
  }
  return exit_code;
}

}  // namespace
}  // namespace cpslam::program

int main(int argc, char** argv) {
  using namespace cpslam::program;
  return run_program("rgbd_tum", [&] {
    std::optional<int> exit_code;
    const RgbdTumOptions options = parse_command_line(argc, argv, exit_code);
    return exit_code ? *exit_code : main_program(options);
  });
}
