#pragma once

#include <cstdint>
#include <string>

#include "common/dense_options.h"
#include "common/detector_options.h"
#include "common/map_options.h"
#include "cpslam/settings.h"

namespace cpslam::program {

/// The window.
struct ViewerChoice {
  bool show = false;
  std::string final_picture;  ///< PNG file; empty: none

  [[nodiscard]] bool wanted() const { return show || !final_picture.empty(); }
};

/// What every program that runs a System takes from its command line.
struct SlamOptions {
  std::string vocabulary;  ///< "-" for the bundled one
  std::string settings;    ///< settings file; where a program can do without: empty
  std::string output = ".";
  bool sequential = false;
  bool realtime = false;
  bool no_loop = false;
  bool print_settings = false;
  bool quiet = false;
  std::uint64_t seed = 0;
  DetectorOptions detector;
  MapOptions maps;
  ViewerChoice viewer;
  DenseOptions dense;
};

/// The argument VOCABULARY.
void add_vocabulary_argument(CLI::App& app, SlamOptions& options);

/// Adds them to a program's options, in its help's groups "How to run", those of add_detector_options(),
/// add_map_options() and add_dense_options(), "Viewer" and "Results and messages". realtime_help: what
/// --realtime does there. The results are good after check().
void add_slam_options(CLI::App& app, SlamOptions& options, const std::string& realtime_help);

/// Completes what is only implied. Throws CLI::ValidationError for options that contradict each other.
void check(SlamOptions& options);

/// Writes what was said over the settings. Throws InputError when the vocabulary, the network or the viewer
/// is missing.
void apply(const SlamOptions& options, Settings& settings);

}  // namespace cpslam::program
