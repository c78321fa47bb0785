#include "common/map_report.h"

#include <nlohmann/json.hpp>

#include "common/report_text.h"

namespace cpslam::program {

nlohmann::ordered_json loaded_map_json(const LoadedMapStatistics& loaded) {
  nlohmann::ordered_json json = {{"keyframes", loaded.keyframes},
                                 {"points", loaded.points},
                                 {"other_vocabulary", loaded.other_vocabulary},
                                 {"found_time_s", nullptr},
                                 {"frames_before_found", loaded.frames_before_found}};
  if (loaded.found_time_s) json["found_time_s"] = *loaded.found_time_s;
  return json;
}

std::string loaded_map_text(const LoadedMapStatistics& loaded) {
  std::string text = line("loaded map  %zu keyframes, %zu points%s", loaded.keyframes, loaded.points,
                          loaded.other_vocabulary ? " (its words found anew: another vocabulary)" : "");
  if (!loaded.found_time_s) return text + "            the camera was never recognised in it\n";
  return text + line("            recognised at %.3f s, after %zu frames", *loaded.found_time_s,
                     loaded.frames_before_found);
}

}  // namespace cpslam::program
