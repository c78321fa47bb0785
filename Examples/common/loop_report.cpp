#include "common/loop_report.h"

#include <nlohmann/json.hpp>

#include "common/report_text.h"

namespace cpslam::program {
namespace {

double longest_ms(const Statistics& statistics, const std::string& stage) {
  const StageTimes* times = find_stage(statistics, stage);
  return times != nullptr ? times->max_ms : 0.0;
}

}  // namespace

bool has_loops(const RunReport& report) {
  return report.settings.loops.enabled && !report.settings.vocabulary.empty();
}

nlohmann::ordered_json loops_json(const Statistics& statistics) {
  const LoopStatistics& loops = statistics.loops;
  nlohmann::ordered_json json = {
      {"closed", loops.events.size()},
      {"full_bundle_adjustments", loops.full_bundle_adjustments},
      {"full_bundle_adjustments_given_up", loops.full_bundle_adjustments_given_up}};
  json["events"] = nlohmann::ordered_json::array();
  for (const LoopEvent& event : loops.events) {
    json["events"].push_back({{"time_s", event.time_s},
                              {"matched_time_s", event.matched_time_s},
                              {"inliers", event.inliers},
                              {"error_m", event.error_m},
                              {"error_deg", event.error_deg}});
    nlohmann::ordered_json& joined = json["events"].back()["joined_map"];
    if (event.joined_map != 0) joined = event.joined_map;
  }
  return json;
}

std::string loops_text(const Statistics& statistics) {
  const LoopStatistics& loops = statistics.loops;
  std::string text =
      line("loops       %zu closed, %zu bundle adjustments of the whole map (%zu given up)",
           loops.events.size(), loops.full_bundle_adjustments, loops.full_bundle_adjustments_given_up);
  for (const LoopEvent& event : loops.events) {
    if (event.joined_map != 0) {
      text += line("            at %.3f s the place of %.3f s: map %d joined to the older one; %d points",
                   event.time_s, event.matched_time_s, event.joined_map, event.inliers);
      continue;
    }
    text += line("            at %.3f s the place of %.3f s: off by %.3f m, %.2f degrees; %d points",
                 event.time_s, event.matched_time_s, event.error_m, event.error_deg, event.inliers);
  }
  if (loops.events.empty()) return text;
  text += line(
      "            at most %.0f ms for a pose graph, %.0f ms for the whole map, which stood still for %.0f "
      "ms",
      longest_ms(statistics, "loop: pose graph"), longest_ms(statistics, "loop: full bundle adjustment"),
      longest_ms(statistics, "loop: moving the map"));
  return text;
}

nlohmann::ordered_json loop_settings_json(const LoopSettings& settings) {
  return {{"enabled", settings.enabled},
          {"min_inliers", settings.min_inliers},
          {"consistent_keyframes", settings.consistent_keyframes}};
}

}  // namespace cpslam::program
