#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cpslam/settings.h"

namespace CLI {
class App;
}

namespace cpslam::program {

/// What the command line says about the detector's network; what is empty was not said.
struct NetworkOptions {
  std::vector<std::string> model;    ///< .cfg and .weights
  std::vector<std::string> classes;  ///< indices or names
  std::string calibration;           ///< folder with pictures: run the network in 8-bit integers
  std::vector<int> input_size;       ///< px: width and height
  std::optional<double> confidence;
  std::optional<double> weak_confidence;
  std::optional<double> nms;
  std::optional<int> n_threads;
};

/// Adds them to a program's options.
void add_network_options(CLI::App& app, const std::string& group, NetworkOptions& options);

/// The first of these options that was given, "--classes"; empty when none was.
[[nodiscard]] std::string first_given(const NetworkOptions& options);

/// Writes what was said over the settings; the network is the bundled one when none was named. Throws
/// InputError when there is none, or for a class it does not know.
void apply(const NetworkOptions& options, DetectorSettings& settings);

}  // namespace cpslam::program
