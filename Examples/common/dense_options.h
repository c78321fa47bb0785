#pragma once

#include <string>

#include "cpslam/dense_map.h"
#include "cpslam/settings.h"

namespace CLI {
class App;
}

namespace cpslam::program {

/// What a program's command line says about the dense map.
struct DenseOptions {
  std::string save_cloud;    ///< file; empty: none
  std::string save_octomap;  ///< likewise
  DenseMapOptions map;
  double octomap_resolution_m = 0.05;
  int memory_mb = DenseSettings().memory_mb;

  [[nodiscard]] bool wanted() const { return !save_cloud.empty() || !save_octomap.empty(); }
};

/// Adds them to a program's options, in its help's group "Dense map without people".
void add_dense_options(CLI::App& app, DenseOptions& options);

/// Throws CLI::ValidationError for options that would do nothing. localization: no keyframes are made.
void check(const DenseOptions& options, bool localization);

/// Throws InputError for a file that could not be written at the end.
void check_files(const DenseOptions& options);

void apply(const DenseOptions& options, Settings& settings);

}  // namespace cpslam::program
