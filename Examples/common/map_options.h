#pragma once

#include <string>

#include "cpslam/settings.h"

namespace CLI {
class App;
}

namespace cpslam::program {

/// Which maps a program begins with and leaves behind.
struct MapOptions {
  std::string load_map;  ///< empty: begin with nothing
  std::string save_map;  ///< empty: save none
  bool localization = false;
};

void add_map_options(CLI::App& app, MapOptions& options);

/// Throws CLI::ValidationError for options that do not go together.
void check(const MapOptions& options);

void apply(const MapOptions& options, Settings& settings);

}  // namespace cpslam::program
