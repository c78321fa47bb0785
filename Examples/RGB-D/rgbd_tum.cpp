// rgbd_tum: tracks an RGB-D sequence in TUM format.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "common/console_log.h"
#include "common/progress_bar.h"
#include "common/run_program.h"
#include "common/run_report.h"
#include "common/stop_signal.h"
#include "cpslam/error.h"
#include "cpslam/system.h"
#include "frame_pacer.h"
#include "io/atomic_file.h"
#include "io/image_reader.h"
#include "io/trajectory_error.h"
#include "io/trajectory_io.h"
#include "io/tum_sequence.h"
#include "rgbd_tum_options.h"

namespace cpslam::program {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kReadAhead = 8;
constexpr std::size_t kMaxWarnings = 10;

Settings effective_settings(const RgbdTumOptions& options) {
  Settings settings = load_settings(options.settings);
  settings.sequential = options.sequential;
  settings.realtime = options.realtime;
  settings.seed = options.seed;
  return settings;
}

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

/// Refuses early what would only fail when the results are written.
void prepare_output(const std::string& dir) {
  std::error_code error;
  fs::create_directories(dir, error);
  const fs::path probe = fs::path(dir) / ".rgbd_tum_probe";
  const bool writable = !error && fs::is_directory(dir) && std::ofstream(probe).put('\n').good();
  fs::remove(probe, error);
  if (!writable) throw InputError("--output " + dir + ": cannot write there");
}

void check_vocabulary(const RgbdTumOptions& options) {
  if (options.vocabulary != "-" && !fs::exists(options.vocabulary)) {
    throw InputError(options.vocabulary + ": no such vocabulary; give - to go without");
  }
  if (!options.quiet) {
    std::fprintf(stderr, "note: this version does not recognise places: no loops are closed%s\n",
                 options.vocabulary == "-" ? "" : ", and the vocabulary is not read");
  }
}

/// Counts and names the frames that could not be used, the first few of them one by one.
class UnusableFrames {
 public:
  explicit UnusableFrames(ProgressBar& bar) : bar_(bar) {}
  void add(double time_s, const std::string& reason) {
    if (++count_ > kMaxWarnings) return;
    char stamp[32];
    std::snprintf(stamp, sizeof stamp, "%.6f", time_s);
    bar_.print_line("warning: frame " + std::string(stamp) + " left out: " + reason);
    if (count_ == kMaxWarnings) bar_.print_line("warning: further frames that are left out are only counted");
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  ProgressBar& bar_;
  std::size_t count_ = 0;
};

/// Feeds the sequence; returns 0 or 1 and fills the report's counts. Whatever fails, the system keeps what it
/// has.
int run(System& system, const std::vector<RgbdEntry>& entries, ProgressBar& bar, RunReport& report) {
  ReadAhead reader(entries, kReadAhead);
  UnusableFrames unusable(bar);
  FramePacer pacer;
  RgbdImages images;
  int exit_code = kExitOk;
  for (std::size_t done = 0; !stop_requested() && reader.next(images); bar.update(++done)) {
    if (!images.error.empty()) {
      unusable.add(images.time_s, images.error);
      continue;
    }
    if (report.settings.realtime && !pacer.wait_for(images.time_s, 1.0 / report.settings.camera.fps)) {
      ++report.dropped;
      continue;
    }
    try {
      system.track(images.colour, images.depth, images.time_s, images.depth_time_s);
    } catch (const InputError& error) {
      unusable.add(images.time_s, error.what());
    } catch (const std::exception& error) {
      bar.print_line(std::string("error: ") + error.what() + "; saving what was tracked");
      exit_code = kExitFailure;
      break;
    }
  }
  report.interrupted = stop_requested();
  report.unreadable = unusable.count();
  return report.unreadable > 0 ? kExitFailure : exit_code;
}

/// Finishes the system and writes every result that can be written, one failure not costing the others.
int save(System& system, const RgbdTumOptions& options, RunReport& report) {
  int exit_code = kExitOk;
  const auto attempt = [&exit_code](const auto& step) {
    try {
      step();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "error: %s\n", error.what());
      exit_code = kExitFailure;
    }
  };
  const fs::path dir = options.output;
  Trajectory trajectory;
  attempt([&] { system.shutdown(); });
  attempt([&] {
    trajectory = system.trajectory();
    write_trajectory((dir / "CameraTrajectory.txt").string(), trajectory);
  });
  attempt([&] { write_trajectory((dir / "KeyFrameTrajectory.txt").string(), system.keyframe_trajectory()); });
  const fs::path truth = fs::path(options.sequence) / "groundtruth.txt";
  if (fs::exists(truth)) {
    attempt([&] { report.ate = absolute_trajectory_error(read_trajectory(truth.string()), trajectory); });
  }
  report.statistics = system.statistics();
  report.peak_memory_mb = peak_memory_mb();
  attempt([&] { write_file_atomically((dir / "stats.json").string(), to_json(report)); });
  return exit_code;
}

int main_program(const RgbdTumOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  RunReport report;
  report.version = CPSLAM_VERSION;
  report.sequence = options.sequence;
  report.settings = effective_settings(options);
  if (options.print_settings) std::cout << to_yaml(report.settings) << std::flush;
  check_vocabulary(options);
  const std::vector<RgbdEntry> entries = select_entries(options);
  prepare_output(options.output);
  report.frames_in_sequence = entries.size();

  install_stop_signal();
  ProgressBar bar("tracking", entries.size(), !options.quiet);
  System system(report.settings, console_log(bar, options.quiet));
  const int run_code = run(system, entries, bar, report);
  bar.finish();
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const int save_code = save(system, options, report);
  if (!options.quiet) {
    std::cout << to_text(report) << "results     " << (fs::path(options.output) / "").string()
              << "{CameraTrajectory.txt, KeyFrameTrajectory.txt, stats.json}\n";
  }
  if (report.statistics.frames == 0 && !report.interrupted) {
    throw InputError(options.sequence + ": none of its " + std::to_string(entries.size()) +
                     " frames could be used");
  }
  return std::max(run_code, save_code);
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
