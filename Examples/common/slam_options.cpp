#include "common/slam_options.h"

#include <CLI/CLI.hpp>
#include <optional>

#include "common/viewer_session.h"
#include "cpslam/error.h"
#include "io/bundled_file.h"

namespace cpslam::program {
namespace {

void add_run_options(CLI::App& app, SlamOptions& options, const std::string& realtime_help) {
  const std::string group = "How to run";
  auto* sequential = app.add_flag("--sequential", options.sequential,
                                  "All stages one after the other: the same result to the bit in every run")
                         ->group(group);
  app.add_flag("--realtime", options.realtime, realtime_help)->excludes(sequential)->group(group);
  app.add_flag("--no-loop", options.no_loop, "Close no loops")->group(group);
  app.add_option("--seed", options.seed, "Seed of every random draw")->capture_default_str()->group(group);
}

void add_output_options(CLI::App& app, SlamOptions& options) {
  const std::string group = "Results and messages";
  app.add_option("--output", options.output, "Folder for the results, made when missing")
      ->capture_default_str()
      ->group(group);
  app.add_flag("--print-settings", options.print_settings, "Print the effective settings and go on")
      ->group(group);
  app.add_flag("--quiet", options.quiet, "No progress and no summary; warnings and errors only")
      ->group(group);
}

void add_viewer_options(CLI::App& app, ViewerChoice& viewer) {
  const std::string group = "Viewer";
  app.add_flag("--viewer", viewer.show,
               "Show the camera's picture and the map in a window; closing it ends the run, and what was\n"
               "tracked is saved")
      ->group(group);
  app.add_option(
         "--viewer-screenshot", viewer.final_picture,
         "The window's picture at the end of the run, as PNG; the window closes then. Implies --viewer")
      ->group(group);
}

std::string find_vocabulary(const std::string& name) {
  if (name != "-") return name;
  const std::string bundled = "Vocabulary/cpslam.voc";
  if (std::optional<std::string> path = find_bundled_file(bundled)) return *path;
  throw InputError("the bundled vocabulary is missing: " + not_bundled_text(bundled) +
                   "; name another one instead of -");
}

}  // namespace

void add_vocabulary_argument(CLI::App& app, SlamOptions& options) {
  app.add_option("VOCABULARY", options.vocabulary,
                 "Vocabulary to recognise places with: ours, or a public ORB vocabulary (ORBvoc.txt);\n"
                 "- for the bundled one")
      ->required();
}

void add_slam_options(CLI::App& app, SlamOptions& options, const std::string& realtime_help) {
  add_run_options(app, options, realtime_help);
  add_detector_options(app, options.detector);
  add_map_options(app, options.maps);
  add_dense_options(app, options.dense);
  add_viewer_options(app, options.viewer);
  add_output_options(app, options);
}

void check(SlamOptions& options) {
  check(options.detector, options.realtime);
  check(options.maps);
  check(options.dense, options.maps.localization);
}

void apply(const SlamOptions& options, Settings& settings) {
  if (options.viewer.wanted()) require_viewer();
  settings.sequential = options.sequential;
  settings.realtime = options.realtime;
  settings.seed = options.seed;
  settings.loops.enabled = !options.no_loop;
  settings.vocabulary = find_vocabulary(options.vocabulary);
  apply(options.detector, settings);
  apply(options.maps, settings);
  apply(options.dense, settings);
}

}  // namespace cpslam::program
