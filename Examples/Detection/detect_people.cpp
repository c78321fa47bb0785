// detect_people: runs the person detector of rgbd_tum over pictures and lists the boxes.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "common/console_log.h"
#include "common/left_out.h"
#include "common/network_options.h"
#include "common/output_folder.h"
#include "common/picture_source.h"
#include "common/progress_bar.h"
#include "common/run_program.h"
#include "common/stop_signal.h"
#include "cpslam/error.h"
#include "detect/yolo_detector.h"
#include "detection_report.h"
#include "io/atomic_file.h"
#include "io/image_reader.h"
#include "io/person_boxes.h"

namespace cpslam::program {
namespace {

struct DetectPeopleOptions {
  std::string source;
  NetworkOptions network;
  std::string output;         ///< file; empty: stdout
  std::string compare_float;  ///< file for the float network's boxes
  std::string report;         ///< file
  bool quiet = false;
};

DetectPeopleOptions parse_command_line(int argc, char** argv, std::optional<int>& exit_code) {
  DetectPeopleOptions options;
  CLI::App app{
      "Finds people in pictures with the detector of rgbd_tum and lists their boxes, one a line:\n"
      "'PICTURE x y width height confidence', or for a sequence 'timestamp x y width height confidence', "
      "which\n"
      "rgbd_tum takes as --boxes. Pixels, top left corner.\n\n"
      "Examples:\n"
      "  detect_people photo.jpg\n"
      "  detect_people ~/rgbd_bonn_crowd --output boxes.txt\n"
      "  detect_people val.txt --model yc.cfg yc.weights --input-size 320 --output boxes.txt --report "
      "report.json"};
  app.add_option(
         "PICTURES", options.source,
         "A sequence (a folder with rgb.txt), any other folder with pictures, a list (.txt, one path a\n"
         "line, relative to the list), or a picture")
      ->required();
  add_network_options(app, "The network", options.network);
  const std::string group = "Results and messages";
  app.add_option("--output", options.output, "File for the boxes; default stdout")
      ->type_name("FILE")
      ->group(group);
  app.add_option(
         "--compare-float", options.compare_float,
         "With --quantise: run the network in floats as well, on every picture in turns with the 8-bit\n"
         "one, compare their times and write the boxes that it finds there")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--report", options.report, "Write times, sizes of the pictures and settings as JSON")
      ->type_name("FILE")
      ->group(group);
  app.add_flag("--quiet", options.quiet, "No progress and no summary; warnings and errors only")
      ->group(group);
  app.callback([&options] {
    if (!options.compare_float.empty() && options.network.calibration.empty())
      throw CLI::ValidationError("--compare-float", "needs --quantise DIR");
  });
  app.set_version_flag("--version", "detect_people (CP-SLAM) " CPSLAM_VERSION);
  exit_code = parse(app, "detect_people", argc, argv);
  return options;
}

/// Boxes on their way to a file, or line by line to stdout.
class BoxList {
 public:
  explicit BoxList(std::string file) : file_(std::move(file)) {}

  void add(const std::string& key, const std::vector<PersonBox>& boxes) {
    std::string lines;
    for (const PersonBox& box : boxes) lines += key + " " + to_text(box) + "\n";
    if (file_.empty()) {
      std::cout << lines << std::flush;
      if (!std::cout) throw RunError("cannot write the boxes to stdout");
    } else {
      text_ += lines;
    }
  }
  void write() const {
    if (!file_.empty()) write_file_atomically(file_, text_);
  }

 private:
  std::string file_;
  std::string text_;
};

/// A detector with what it found and how long it took.
class TimedDetector {
 public:
  TimedDetector(const DetectorSettings& settings, const Log& log, const std::string& file)
      : detector_(make_yolo_detector(settings, log)), boxes_(file) {}

  [[nodiscard]] std::string name() const { return detector_->name(); }
  void detect(const cv::Mat& colour, const Picture& picture) {
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<PersonBox> found = detector_->detect(colour, picture.time_s.value_or(0.0));
    ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    n_found_ = found.size();
    boxes_.add(picture.key, found);
  }
  /// Of the latest picture.
  [[nodiscard]] double ms() const { return ms_; }
  [[nodiscard]] std::size_t n_found() const { return n_found_; }
  void write() const { boxes_.write(); }

 private:
  std::unique_ptr<PersonDetector> detector_;
  BoxList boxes_;
  double ms_ = 0.0;
  std::size_t n_found_ = 0;
};

/// The detector, with --compare-float the one in floats beside it.
class Detectors {
 public:
  Detectors(const DetectPeopleOptions& options, const DetectorSettings& settings, const Log& log)
      : detector_(settings, log, options.output) {
    if (options.compare_float.empty()) return;
    DetectorSettings in_floats = settings;
    in_floats.quantise = false;
    floats_.emplace(in_floats, log, options.compare_float);
  }

  [[nodiscard]] std::string name() const { return detector_.name(); }
  [[nodiscard]] LookedAt look_at(const Picture& picture) {
    const cv::Mat colour = read_colour_image(picture.path);
    // In turns, so that neither always finds the caches as the other left them.
    floats_first_ = !floats_first_;
    if (floats_ && floats_first_) floats_->detect(colour, picture);
    detector_.detect(colour, picture);
    if (floats_ && !floats_first_) floats_->detect(colour, picture);
    LookedAt result{picture.key, colour.cols, colour.rows, detector_.n_found(), detector_.ms(), std::nullopt};
    if (floats_) result.float_ms = floats_->ms();
    return result;
  }
  void write() const {
    detector_.write();
    if (floats_) floats_->write();
  }

 private:
  TimedDetector detector_;
  std::optional<TimedDetector> floats_;
  bool floats_first_ = false;
};

void look_at_all(Detectors& detectors, const std::vector<Picture>& pictures, ProgressBar& bar,
                 DetectionReport& report) {
  LeftOut left_out("picture", bar);
  for (std::size_t i = 0; i < pictures.size() && !stop_requested(); bar.update(++i)) {
    try {
      report.pictures.push_back(detectors.look_at(pictures[i]));
    } catch (const InputError& error) {
      left_out.add(pictures[i].key, error.what());
      report.left_out.push_back(pictures[i].key);
    }
  }
  report.interrupted = stop_requested();
}

void check_files(const DetectPeopleOptions& options) {
  for (const auto& [option, file] : {std::pair("--output", options.output),
                                     {"--compare-float", options.compare_float},
                                     {"--report", options.report}}) {
    if (!file.empty()) check_writable(option, file);
  }
}

int detect_people(const DetectPeopleOptions& options) {
  const std::vector<Picture> pictures = find_pictures(options.source);
  check_files(options);
  DetectionReport report;
  report.version = CPSLAM_VERSION;
  report.source = options.source;
  report.settings.kind = DetectorKind::kYolo;
  apply(options.network, report.settings);
  // What stands in one picture goes on from nothing in another.
  if (!pictures.front().time_s)
    report.settings.weak_confidence_threshold = report.settings.confidence_threshold;

  ProgressBar bar("detecting", pictures.size(), !options.quiet);
  Detectors detectors(options, report.settings, Log(console_log(bar, options.quiet)));
  report.network = detectors.name();
  install_stop_signal();
  look_at_all(detectors, pictures, bar, report);
  bar.finish();
  if (report.pictures.empty() && !report.interrupted) {
    throw InputError("'" + options.source + "': none of its " + std::to_string(pictures.size()) +
                     " pictures could be read");
  }
  detectors.write();
  if (!options.report.empty()) write_file_atomically(options.report, to_json(report));
  // Boxes on stdout stay among themselves.
  if (!options.quiet) (options.output.empty() ? std::cerr : std::cout) << to_text(report) << std::flush;
  return report.left_out.empty() ? kExitOk : kExitFailure;
}

}  // namespace
}  // namespace cpslam::program

int main(int argc, char** argv) {
  using namespace cpslam::program;
  return run_program("detect_people", [&] {
    std::optional<int> exit_code;
    const DetectPeopleOptions options = parse_command_line(argc, argv, exit_code);
    return exit_code ? *exit_code : detect_people(options);
  });
}
