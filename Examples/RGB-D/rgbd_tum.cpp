// rgbd_tum: tracks an RGB-D sequence in TUM format.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "common/console_log.h"
#include "common/output_folder.h"
#include "common/picture_writer.h"
#include "common/progress_bar.h"
#include "common/run_program.h"
#include "common/run_report.h"
#include "common/stop_signal.h"
#include "cpslam/error.h"
#include "cpslam/system.h"
#include "detect/recording_detector.h"
#include "io/atomic_file.h"
#include "io/bundled_file.h"
#include "io/person_boxes.h"
#include "io/trajectory_error.h"
#include "io/trajectory_io.h"
#include "io/tum_sequence.h"
#include "rgbd_tum_options.h"
#include "run_sequence.h"

namespace cpslam::program {
namespace {

namespace fs = std::filesystem;

std::string find_vocabulary(const std::string& name) {
  if (name != "-") return name;
  const std::string bundled = "Vocabulary/cpslam.voc";
  if (std::optional<std::string> path = find_bundled_file(bundled)) return *path;
  throw InputError("the bundled vocabulary is missing: " + not_bundled_text(bundled) +
                   "; name another one instead of -");
}

Settings effective_settings(const RgbdTumOptions& options) {
  Settings settings = load_settings(options.settings);
  settings.sequential = options.sequential;
  settings.realtime = options.realtime;
  settings.seed = options.seed;
  settings.loops.enabled = !options.no_loop;
  settings.vocabulary = find_vocabulary(options.vocabulary);
  apply(options.detector, settings);
  apply(options.maps, settings);
  return settings;
}

/// Nobody has said that people do not matter.
void note_missing_detector(const RgbdTumOptions& options) {
  if (!options.detector.without_network || options.quiet) return;
  std::fprintf(stderr, "note: people are not looked for: %s. --model CFG WEIGHTS names a network\n",
               no_bundled_detector_model_text().c_str());
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

/// The settings' detector, wrapped to keep what it finds when that is to be saved.
std::unique_ptr<PersonDetector> make_recorded_detector(const RgbdTumOptions& options,
                                                       const Settings& settings, const LogSink& log,
                                                       const RecordingDetector*& recorder) {
  std::unique_ptr<PersonDetector> detector = make_detector(settings.detector, log);
  if (options.detector.save_boxes.empty()) return detector;
  auto recording = std::make_unique<RecordingDetector>(std::move(detector));
  recorder = recording.get();
  return recording;
}

std::unique_ptr<PictureWriter> make_picture_writer(const RgbdTumOptions& options, const LogSink& log) {
  if (options.detector.draw.empty()) return nullptr;
  using WhenBusy = PictureWriter::WhenBusy;
  const WhenBusy when_busy = options.realtime ? WhenBusy::kLeaveOut : WhenBusy::kWait;
  return std::make_unique<PictureWriter>(options.detector.draw, when_busy, log);
}

/// Finishes the system and writes every result that can be written, one failure not costing the others.
int save(System& system, const RgbdTumOptions& options, const RecordingDetector* recorder,
         RunReport& report) {
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
  if (!options.maps.save_map.empty()) attempt([&] { system.save_map(options.maps.save_map); });
  if (recorder != nullptr)
    attempt([&] { write_person_boxes(options.detector.save_boxes, recorder->recorded()); });
  const fs::path truth = fs::path(options.sequence) / "groundtruth.txt";
  if (fs::exists(truth)) {
    attempt([&] { report.ate = absolute_trajectory_error(read_trajectory(truth.string()), trajectory); });
  }
  report.statistics = system.statistics();
  report.peak_memory_mb = peak_memory_mb();
  attempt([&] { write_file_atomically((dir / "stats.json").string(), to_json(report)); });
  return exit_code;
}

void print_summary(const RgbdTumOptions& options, const RunReport& report, const PictureWriter* pictures) {
  std::cout << to_text(report) << "results     " << (fs::path(options.output) / "").string()
            << "{CameraTrajectory.txt, KeyFrameTrajectory.txt, stats.json}\n";
  if (!options.maps.save_map.empty()) std::cout << "map file    " << options.maps.save_map << "\n";
  if (!options.detector.save_boxes.empty())
    std::cout << "boxes       " << options.detector.save_boxes << "\n";
  if (pictures == nullptr) return;
  std::cout << "pictures    " << (fs::path(options.detector.draw) / "").string();
  if (pictures->left_out() > 0) std::cout << ", without " << pictures->left_out() << " to keep up";
  std::cout << "\n";
}

/// The detector's thread is inside somebody else's code that does not return, and cannot be ended alone.
[[noreturn]] void end_beside_stuck_detector() {
  std::cout << std::flush;
  std::fprintf(stderr, "error: the person detector has not come back; ending without it\n");
  std::fflush(nullptr);
  std::_Exit(kExitFailure);
}

int main_program(const RgbdTumOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  RunReport report;
  report.version = CPSLAM_VERSION;
  report.sequence = options.sequence;
  report.settings = effective_settings(options);
  if (options.print_settings) std::cout << to_yaml(report.settings) << std::flush;
  note_missing_detector(options);
  const std::vector<RgbdEntry> entries = select_entries(options);
  prepare_output_folder("--output", options.output);
  if (!options.detector.save_boxes.empty()) check_folder_of("--save-boxes", options.detector.save_boxes);
  if (!options.maps.save_map.empty()) check_folder_of("--save-map", options.maps.save_map);
  report.frames_in_sequence = entries.size();

  ProgressBar bar("tracking", entries.size(), !options.quiet);
  const LogSink log = console_log(bar, options.quiet);
  const RecordingDetector* recorder = nullptr;
  std::unique_ptr<PersonDetector> detector = make_recorded_detector(options, report.settings, log, recorder);
  const std::unique_ptr<PictureWriter> pictures = make_picture_writer(options, log);
  System system(report.settings, std::move(detector), log);
  install_stop_signal();
  const int run_code = run_sequence(system, entries, bar, pictures.get(), report);
  if (pictures) pictures->finish();
  bar.finish();
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const int save_code = save(system, options, recorder, report);
  if (!options.quiet) print_summary(options, report, pictures.get());
  const PeopleStatistics& people = report.statistics.people;
  if (people.detector_stuck) end_beside_stuck_detector();
  if (report.statistics.frames == 0 && !report.interrupted) {
    throw InputError(options.sequence + ": none of its " + std::to_string(entries.size()) +
                     " frames could be used");
  }
  return std::max({run_code, save_code, people.detector_failures > 0 ? kExitFailure : kExitOk});
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
