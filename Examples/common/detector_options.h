#pragma once

#include <optional>
#include <string>

#include "common/network_options.h"
#include "cpslam/settings.h"

namespace CLI {
class App;
}

namespace cpslam::program {

/// What the command line says about people; what is empty was not said.
struct DetectorOptions {
  std::optional<DetectorKind> kind;
  bool without_network = false;  ///< kNone only because there is no network to run
  std::string boxes_file;
  NetworkOptions network;
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

/// Says which detector it is when that is only implied: boxes or yolo by their files, else yolo when there is
/// a bundled network, else none. Throws CLI::ValidationError for options that contradict each other.
void check(DetectorOptions& options, bool realtime);

/// Writes what was said over the settings. Throws InputError as apply(NetworkOptions) does.
void apply(const DetectorOptions& options, Settings& settings);

}  // namespace cpslam::program
