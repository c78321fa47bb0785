#include "common/map_report.h"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "common/report_text.h"

namespace cpslam::program {
namespace {

std::ptrdiff_t joined_maps(const Statistics& statistics) {
  const std::vector<LoopEvent>& events = statistics.loops.events;
  return std::count_if(events.begin(), events.end(),
                       [](const LoopEvent& event) { return event.joined_map != 0; });
}

}  // namespace

nlohmann::ordered_json loaded_map_json(const LoadedMapStatistics& loaded) {
  nlohmann::ordered_json json = {
      {"maps", loaded.maps},     {"keyframes", loaded.keyframes},
      {"points", loaded.points}, {"other_vocabulary", loaded.other_vocabulary},
      {"found_time_s", nullptr}, {"frames_before_found", loaded.frames_before_found}};
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

nlohmann::ordered_json maps_json(const Statistics& statistics) {
  nlohmann::ordered_json json = {{"started", statistics.maps_started}, {"joined", joined_maps(statistics)}};
  json["at_end"] = nlohmann::ordered_json::array();
  for (const MapCounts& map : statistics.maps)
    json["at_end"].push_back({{"map", map.map}, {"frames", map.frames}, {"keyframes", map.keyframes}});
  return json;
}

std::string maps_text(const Statistics& statistics) {
  const std::vector<MapCounts>& maps = statistics.maps;
  if (statistics.maps_started < 2 && maps.size() < 2) return {};
  std::string text = line("maps        %zu begun, %td joined to an older one by a loop",
                          statistics.maps_started, joined_maps(statistics));
  for (const MapCounts& map : maps) {
    text += line("            map %d: %zu frames, %zu keyframes%s", map.map, map.frames, map.keyframes,
                 &map == maps.data() ? "" : ", nothing connects it to the first");
  }
  if (maps.size() > 1 && maps[1].frames > 0)
    text += line("            CameraTrajectory.txt is of map %d, CameraTrajectory_map%d.txt of map %d%s",
                 maps[0].map, maps[1].map, maps[1].map, maps.size() > 2 ? " and so on" : "");
  return text;
}

}  // namespace cpslam::program
