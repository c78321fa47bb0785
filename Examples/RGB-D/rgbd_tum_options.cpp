#include "rgbd_tum_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "common/run_program.h"

namespace cpslam::program {
namespace {

/// Takes whole numbers only: CLI11 would turn -1 into a very large count.
std::string check_count(const std::string& text) {
  const bool whole =
      !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return whole ? std::string() : "'" + text + "' is not a whole number of at least 0";
}

std::string check_positive_count(const std::string& text) {
  const bool zero = text.find_first_not_of('0') == std::string::npos;
  return zero ? "must be at least 1, not " + text : check_count(text);
}

void add_input_options(CLI::App& app, RgbdTumOptions& options) {
  const std::string group = "What to run on";
  app.add_option("VOCABULARY", options.vocabulary,
                 "Vocabulary to recognise places with: ours, or a public ORB vocabulary (ORBvoc.txt);\n"
                 "- for the bundled one")
      ->required();
  app.add_option("SETTINGS", options.settings, "Camera and feature settings (ORB-SLAM2's format)")
      ->required();
  app.add_option("SEQUENCE", options.sequence, "Folder with rgb.txt, depth.txt and the images")->required();
  app.add_option(
      "ASSOCIATIONS", options.associations,
      "Colour-depth pairs as associate.py writes them; left out: rgb.txt and depth.txt are paired here");
  app.add_option("--start", options.start, "First pair of the sequence to use, counted from 0")
      ->check(check_count)
      ->capture_default_str()
      ->group(group);
  app.add_option("--max-frames", options.max_frames, "How many pairs to use at most; default all")
      ->check(check_positive_count)
      ->group(group);
}

void add_run_options(CLI::App& app, RgbdTumOptions& options) {
  const std::string group = "How to run";
  auto* sequential = app.add_flag("--sequential", options.sequential,
                                  "All stages one after the other: the same result to the bit in every run")
                         ->group(group);
  app.add_flag("--realtime", options.realtime,
               "Pace by the time stamps and drop frames when late, like a live camera")
      ->excludes(sequential)
      ->group(group);
  app.add_flag("--no-loop", options.no_loop, "Close no loops")->group(group);
  app.add_option("--seed", options.seed, "Seed of every random draw")->capture_default_str()->group(group);
}

void add_output_options(CLI::App& app, RgbdTumOptions& options) {
  const std::string group = "Results and messages";
  app.add_option("--output", options.output, "Folder for the results, made when missing")
      ->capture_default_str()
      ->group(group);
  app.add_flag("--print-settings", options.print_settings, "Print the effective settings and go on")
      ->group(group);
  app.add_flag("--quiet", options.quiet, "No progress and no summary; warnings and errors only")
      ->group(group);
}

}  // namespace

RgbdTumOptions parse_command_line(int argc, char** argv, std::optional<int>& exit_code) {
  RgbdTumOptions options;
  CLI::App app{
      "Tracks an RGB-D sequence in TUM format (TUM RGB-D, Bonn RGB-D Dynamic, simulate_tum) and writes\n"
      "CameraTrajectory.txt, KeyFrameTrajectory.txt and stats.json.\n\n"
      "Examples:\n"
      "  rgbd_tum - Examples/RGB-D/TUM1.yaml ~/rgbd_dataset_freiburg1_desk --output results\n"
      "  rgbd_tum - Examples/RGB-D/Bonn.yaml ~/rgbd_bonn_crowd --boxes boxes.txt --draw pictures"};
  add_input_options(app, options);
  add_run_options(app, options);
  add_detector_options(app, options.detector);
  add_map_options(app, options.maps);
  add_output_options(app, options);
  app.callback([&options] {
    check(options.detector, options.realtime);
    check(options.maps);
  });
  app.set_version_flag("--version", "rgbd_tum (CP-SLAM) " CPSLAM_VERSION);
  exit_code = parse(app, "rgbd_tum", argc, argv);
  return options;
}

}  // namespace cpslam::program
