#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "common/progress_bar.h"
#include "common/stop_signal.h"
#include "cpslam/error.h"
#include "diagnosis/examination.h"
#include "diagnosis/ground_truth.h"
#include "diagnosis/image_list.h"
#include "diagnosis/stamps.h"
#include "examine.h"
#include "io/association.h"
#include "io/image_reader.h"
#include "io/trajectory_io.h"

namespace cpslam::program {
namespace {

namespace fs = std::filesystem;
using diagnosis::Findings;
using diagnosis::ImageList;

constexpr std::size_t kReadAhead = 8;

void append(Findings& findings, const Findings& more) {
  findings.insert(findings.end(), more.begin(), more.end());
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// The settings file named, or the one that came with the sequence; empty for none.
std::string find_settings(const DoctorOptions& options) {
  if (!options.settings.empty()) return options.settings;
  const fs::path beside = fs::path(options.sequence) / "settings.yaml";
  return is_file(beside) ? beside.string() : std::string();
}

/// As associate_sequence() does it, but whatever is wrong with the lists' order.
std::vector<RgbdEntry> pair_up(const ImageList& colour, const ImageList& depth) {
  constexpr double kMaxDifference_s = 0.02;
  std::vector<RgbdEntry> entries;
  for (const auto& [i, j] : associate_stamps(colour.stamps, depth.stamps, kMaxDifference_s))
    entries.push_back({colour.stamps[i], depth.stamps[j], colour.paths[i], depth.paths[j]});
  return entries;
}

/// Only those that are to be looked at.
std::vector<RgbdEntry> choose(const std::vector<RgbdEntry>& all, std::size_t n_wanted) {
  std::vector<RgbdEntry> chosen;
  for (const std::size_t i : diagnosis::choose_frames(all.size(), n_wanted)) chosen.push_back(all[i]);
  return chosen;
}

void look_at_images(const std::vector<RgbdEntry>& entries, bool quiet, diagnosis::Examination& examination) {
  ProgressBar bar("looking", entries.size(), !quiet);
  ReadAhead reader(entries, kReadAhead);
  RgbdImages images;
  while (!stop_requested() && reader.next(images)) {
    examination.add(images);
    bar.update(examination.n_frames());
  }
}

Findings ground_truth(const DoctorOptions& options, const std::vector<double>& colour_s) {
  const fs::path file = fs::path(options.sequence) / "groundtruth.txt";
  if (!is_file(file)) return {};
  try {
    return diagnosis::check_ground_truth(read_trajectory(file.string()), colour_s);
  } catch (const InputError& error) {
    return {{diagnosis::Level::kWarning,
             "ground truth",
             error.what(),
             "correct it: 'timestamp tx ty tz qx qy qz qw' a line",
             {}}};
  }
}

}  // namespace

DoctorReport examine_sequence(const DoctorOptions& options) {
  std::error_code ignored;
  if (!fs::is_directory(options.sequence, ignored))
    throw InputError("sequence '" + options.sequence +
                     "' is not a folder: give the one that holds rgb.txt and depth.txt");
  DoctorReport report;
  report.source = options.sequence;
  report.settings = find_settings(options);
  std::optional<CameraSettings> camera;
  if (!report.settings.empty()) camera = load_settings(report.settings).camera;
  install_stop_signal();
  const ImageList colour = diagnosis::read_image_list(options.sequence, "rgb.txt");
  const ImageList depth = diagnosis::read_image_list(options.sequence, "depth.txt");
  for (const ImageList* const list : {&colour, &depth}) append(report.findings, check_image_list(*list));
  const std::optional<double> fps = camera ? std::optional<double>(camera->fps) : std::nullopt;
  append(report.findings, diagnosis::check_rhythm("colour", colour.stamps, fps));
  append(report.findings, diagnosis::check_rhythm("depth", depth.stamps, std::nullopt));
  append(report.findings, diagnosis::check_pairs(colour.stamps, depth.stamps));
  const std::vector<RgbdEntry> entries = pair_up(colour, depth);
  if (!entries.empty()) {
    diagnosis::Examination examination(camera);
    look_at_images(choose(entries, options.n_frames), options.quiet, examination);
    report.examined = examination.n_frames();
    append(report.findings, examination.findings());
  }
  append(report.findings, ground_truth(options, colour.stamps));
  report.interrupted = stop_requested();
  return report;
}

}  // namespace cpslam::program
