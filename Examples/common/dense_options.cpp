#include "common/dense_options.h"

#include <CLI/CLI.hpp>

#include "common/option_checks.h"
#include "common/output_folder.h"
#include "cpslam/error.h"

namespace cpslam::program {

void add_dense_options(CLI::App& app, DenseOptions& options) {
  const std::string group = "Dense map without people";
  app.add_option("--save-cloud", options.save_cloud,
                 "Write the room's surfaces as points with colour and normals (binary PLY)")
      ->type_name("FILE.ply")
      ->group(group);
  auto* const octomap = app.add_option("--save-octomap", options.save_octomap,
                                       "Write which space is occupied and which is free (OctoMap)")
                            ->type_name("FILE.bt")
                            ->group(group);
  app.add_option("--cloud-voxel", options.map.voxel_m, "One point at most in a cube of this side, m")
      ->check(check_range(0.005, 0.5))
      ->type_name("M")
      ->capture_default_str()
      ->group(group);
  app.add_option("--cloud-max-depth", options.map.max_depth_m,
                 "Surfaces farther from the camera are left out, m")
      ->check(check_range(0.3, 13.0))
      ->type_name("M")
      ->capture_default_str()
      ->group(group);
  app.add_option("--octomap-resolution", options.octomap_resolution_m, "Side of the OctoMap's cells, m")
      ->check(check_range(0.01, 1.0))
      ->needs(octomap)
      ->type_name("M")
      ->capture_default_str()
      ->group(group);
  app.add_option("--cloud-memory", options.memory_mb,
                 "For the keyframes' depth and colour, MB: 0.4 a keyframe; when it is full, some go")
      ->check(CLI::Range(1, 1 << 20))
      ->type_name("MB")
      ->capture_default_str()
      ->group(group);
}

void check(const DenseOptions& options, bool localization) {
  if (options.wanted() && localization)
    throw CLI::ValidationError(options.save_cloud.empty() ? "--save-octomap" : "--save-cloud",
                               "has nothing to show with --localization: no keyframes are made");
  if (options.wanted()) return;
  const std::string why = "has nothing to do without --save-cloud or --save-octomap";
  const DenseOptions usual;
  if (options.map.voxel_m != usual.map.voxel_m) throw CLI::ValidationError("--cloud-voxel", why);
  if (options.map.max_depth_m != usual.map.max_depth_m) throw CLI::ValidationError("--cloud-max-depth", why);
  if (options.memory_mb != usual.memory_mb) throw CLI::ValidationError("--cloud-memory", why);
}

void check_files(const DenseOptions& options) {
  if (!options.save_cloud.empty()) check_writable("--save-cloud", options.save_cloud);
  if (options.save_octomap.empty()) return;
  if (!DenseMap::can_save_octomap())
    throw InputError("--save-octomap: built without OctoMap; install liboctomap-dev and build again");
  check_writable("--save-octomap", options.save_octomap);
}

void apply(const DenseOptions& options, Settings& settings) {
  settings.dense.enabled = options.wanted();
  settings.dense.memory_mb = options.memory_mb;
}

}  // namespace cpslam::program
