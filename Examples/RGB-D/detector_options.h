#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cpslam/settings.h"

namespace CLI {
class App;
}

namespace cpslam::program {

/// What the command line says about people; what is empty was not said.
struct DetectorOptions {
  std::optional<DetectorKind> kind;
  std::string boxes_file;
  std::vector<std::string> model;  ///< .cfg and .weights
  std::vector<int> classes;
  std::string calibration;  ///< folder with pictures: run the network in 8-bit integers
  std::optional<BoxesPolicy> policy;
  std::optional<double> pretend_rate_hz;
  std::optional<double> pretend_delay_s;
  std::optional<PeopleFilter> filter;
  bool no_reinstate = false;
  std::string save_boxes;  ///< file
  std::string draw;        ///< folder
};

/// Adds them to a program's options. The results are good after check().
void add_detector_options(CLI::App& app, DetectorOptions& options);

/// Fills in what is only implied. Throws CLI::ValidationError for options that contradict each other.
void check(DetectorOptions& options, bool realtime);

/// Writes what was said over the settings.
void apply(const DetectorOptions& options, Settings& settings);

}  // namespace cpslam::program
