#include "common/map_options.h"

#include <CLI/CLI.hpp>

namespace cpslam::program {

void add_map_options(CLI::App& app, MapOptions& options) {
  const std::string group = "Maps";
  app.add_option("--load-map", options.load_map,
                 "Begin with this map: frames have no pose until the camera is recognised in it, then poses\n"
                 "are in the map's frame and mapping goes on")
      ->type_name("FILE")
      ->group(group);
  app.add_option(
         "--save-map", options.save_map,
         "Write the map at the end, also of a run that is cut short. What stood there is replaced in\n"
         "one step")
      ->type_name("FILE")
      ->group(group);
  app.add_flag("--localization", options.localization,
               "Only find the camera in the loaded map, which stays as it is. Where the map shows nothing,\n"
               "poses are carried on from frame to frame")
      ->group(group);
}

void check(const MapOptions& options) {
  if (!options.localization) return;
  if (options.load_map.empty()) throw CLI::ValidationError("--localization", "needs --load-map FILE");
  if (!options.save_map.empty())
    throw CLI::ValidationError("--save-map",
                               "has nothing to save with --localization: the map stays as it is");
}

void apply(const MapOptions& options, Settings& settings) {
  settings.load_map = options.load_map;
  settings.localization = options.localization;
}

}  // namespace cpslam::program
