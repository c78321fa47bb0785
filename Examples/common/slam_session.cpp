#include "common/slam_session.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

#include "common/console_log.h"
#include "common/output_folder.h"
#include "common/run_program.h"
#include "common/trajectory_files.h"
#include "cpslam/error.h"
#include "cpslam/trajectory.h"
#include "io/atomic_file.h"
#include "io/person_boxes.h"
#include "io/trajectory_error.h"
#include "io/trajectory_io.h"
#include "util/log.h"

namespace cpslam::program {
namespace {

namespace fs = std::filesystem;

// With the number of a map that was dropped, the oldest 1.
constexpr const char* kDroppedFrames = "CameraTrajectory_dropped";
constexpr const char* kDroppedKeyFrames = "KeyFrameTrajectory_dropped";

/// The settings' detector, wrapped to keep what it finds when that is to be saved.
std::unique_ptr<PersonDetector> make_recorded_detector(const SlamOptions& options, const Settings& settings,
                                                       const LogSink& log,
                                                       const RecordingDetector*& recorder) {
  std::unique_ptr<PersonDetector> detector = make_detector(settings.detector, log);
  if (options.detector.save_boxes.empty()) return detector;
  auto recording = std::make_unique<RecordingDetector>(std::move(detector));
  recorder = recording.get();
  return recording;
}

std::unique_ptr<PictureWriter> make_picture_writer(const SlamOptions& options, const Settings& settings,
                                                   const LogSink& log) {
  if (options.detector.draw.empty()) return nullptr;
  const WhenBusy when_busy = settings.realtime ? WhenBusy::kLeaveOut : WhenBusy::kWait;
  return std::make_unique<PictureWriter>(options.detector.draw, when_busy, log);
}

/// The detector's thread is inside somebody else's code that does not return, and cannot be ended alone.
[[noreturn]] void end_beside_stuck_detector() {
  std::cout << std::flush;
  std::fprintf(stderr, "error: the person detector has not come back; ending without it\n");
  std::fflush(nullptr);
  std::_Exit(kExitFailure);
}

}  // namespace

SlamSession::SlamSession(const SlamOptions& options, const Settings& settings, ProgressBar& bar)
    : options_(options), bar_(bar), log_(console_log(bar, options.quiet)) {
  prepare_output_folder("--output", options_.output);
  for (const char* const name : {kDroppedFrames, kDroppedKeyFrames}) remove_dropped(options_.output, name);
  const std::string& boxes = options_.detector.save_boxes;
  if (!boxes.empty()) check_writable("--save-boxes", boxes);
  const std::string& map = options_.maps.save_map;
  if (!map.empty()) check_writable("--save-map", map);
  check_files(options_.dense);
  std::unique_ptr<PersonDetector> detector = make_recorded_detector(options_, settings, log_, recorder_);
  pictures_ = make_picture_writer(options_, settings, log_);
  system_ = std::make_unique<System>(settings, std::move(detector), log_);
}

TrackResult SlamSession::track(const RgbdFrame& frame) {
  const TrackResult result = system_->track(frame);
  if (pictures_) pictures_->add(frame.colour, system_->frame_view());
  return result;
}

void SlamSession::fulfil(const MapWishes& wishes) {
  const Log log(log_);
  try {
    if (wishes.reset) system_->reset();
    if (wishes.localization) system_->set_localization(*wishes.localization);
  } catch (const InputError& refusal) {
    log.warning(refusal.what());
  }
}

bool SlamSession::save_dropped_maps() const {
  const std::string& dir = options_.output;
  bool saved = true;
  std::size_t number = 0;
  for (const DroppedMap& map : system_->dropped_maps()) {
    const std::string name = std::to_string(++number);
    const auto write = [&] {
      const int main = map_with_most(map.trajectory);
      write_by_map(dir, kDroppedFrames + name, map.trajectory, main);
      write_by_map(dir, kDroppedKeyFrames + name, map.keyframe_trajectory, main);
    };
    saved = attempt(write) && saved;
  }
  return saved;
}

bool SlamSession::save_so_far() {
  const std::string& dir = options_.output;
  const Trajectory trajectory = system_->trajectory();
  const int map_number = map_with_most(trajectory);
  const bool frames = attempt([&] { write_by_map(dir, "CameraTrajectory", trajectory, map_number); });
  const bool keyframes =
      attempt([&] { write_by_map(dir, "KeyFrameTrajectory", system_->keyframe_trajectory(), map_number); });
  const bool dropped = save_dropped_maps();
  const std::string& map = options_.maps.save_map;
  const bool mapped = map.empty() || attempt([&] { system_->save_map(map); });
  return frames && keyframes && dropped && mapped;
}

int SlamSession::finish(const std::string& ground_truth, RunReport& report) {
  if (pictures_) pictures_->finish();
  bar_.finish();
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const bool saved = save(ground_truth, report);
  if (!options_.quiet) print_summary(report);
  const PeopleStatistics& people = report.statistics.people;
  if (people.detector_stuck) end_beside_stuck_detector();
  return saved && people.detector_failures == 0 ? kExitOk : kExitFailure;
}

bool SlamSession::attempt(const std::function<void()>& step) const {
  try {
    step();
    return true;
  } catch (const std::exception& error) {
    bar_.print_line(std::string("error: ") + error.what());
    return false;
  }
}

bool SlamSession::save(const std::string& ground_truth, RunReport& report) {
  bool saved = attempt([&] { system_->shutdown(); });
  saved = save_so_far() && saved;
  if (recorder_ != nullptr) {
    const auto write = [&] { write_person_boxes(options_.detector.save_boxes, recorder_->recorded()); };
    saved = attempt(write) && saved;
  }
  if (fs::exists(ground_truth)) {
    const auto compare = [&] {
      const std::vector<Trajectory> maps = split_by_map(system_->trajectory());
      report.ate = absolute_trajectory_error(read_trajectory(ground_truth),
                                             maps.empty() ? Trajectory() : maps.front());
    };
    saved = attempt(compare) && saved;
  }
  if (options_.dense.wanted()) saved = save_dense_map(report) && saved;
  report.statistics = system_->statistics();
  report.peak_memory_mb = peak_memory_mb();
  const std::string stats = (fs::path(options_.output) / "stats.json").string();
  return attempt([&] { write_file_atomically(stats, to_json(report)); }) && saved;
}

bool SlamSession::save_dense_map(RunReport& report) const {
  const auto start = std::chrono::steady_clock::now();
  const DenseOptions& dense = options_.dense;
  std::optional<DenseMap> map;
  if (!attempt([&] { map = system_->dense_map(dense.map); })) return false;
  const bool cloud = dense.save_cloud.empty() || attempt([&] { map->save_cloud(dense.save_cloud); });
  const bool octomap = dense.save_octomap.empty() ||
                       attempt([&] { map->save_octomap(dense.save_octomap, dense.octomap_resolution_m); });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.dense = {map->points().size(), map->n_views(), map->n_dropped_views(), map->n_carved_voxels(),
                  seconds};
  return cloud && octomap;
}

void SlamSession::print_summary(const RunReport& report) const {
  std::cout << to_text(report) << "results     " << (fs::path(options_.output) / "").string()
            << "{CameraTrajectory.txt, KeyFrameTrajectory.txt, stats.json}\n";
  for (std::size_t i = 1; i <= report.statistics.dropped_maps; ++i) {
    std::cout << "            and, of a map that was dropped, {" << kDroppedFrames << i << ".txt, "
              << kDroppedKeyFrames << i << ".txt}\n";
  }
  if (!options_.maps.save_map.empty()) std::cout << "map file    " << options_.maps.save_map << "\n";
  if (!options_.detector.save_boxes.empty())
    std::cout << "boxes       " << options_.detector.save_boxes << "\n";
  if (!options_.dense.save_cloud.empty()) std::cout << "cloud       " << options_.dense.save_cloud << "\n";
  if (!options_.dense.save_octomap.empty())
    std::cout << "octomap     " << options_.dense.save_octomap << "\n";
  if (!pictures_) return;
  std::cout << "pictures    " << (fs::path(options_.detector.draw) / "").string();
  if (pictures_->left_out() > 0) std::cout << ", without " << pictures_->left_out() << " to keep up";
  std::cout << "\n";
}

void note_missing_detector(const SlamOptions& options) {
  if (!options.detector.without_network || options.quiet) return;
  std::fprintf(stderr, "note: people are not looked for: %s. --model CFG WEIGHTS names a network\n",
               no_bundled_detector_model_text().c_str());
}

}  // namespace cpslam::program
