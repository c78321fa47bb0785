#include "common/live_report.h"

#include <nlohmann/json.hpp>

#include "common/report_text.h"

namespace cpslam::program {

nlohmann::ordered_json live_json(const LiveReport& report) {
  nlohmann::ordered_json json = {{"camera", report.camera},
                                 {"missed", report.missed},
                                 {"unpaired", report.unpaired},
                                 {"clock_jumps", report.clock_jumps},
                                 {"interruptions", report.interruptions},
                                 {"reconnects", report.reconnects}};
  json["latency_ms"] = nullptr;
  if (report.latency.count() > 0) {
    json["latency_ms"] = {{"p50", report.latency.percentile_ms(0.5)},
                          {"p95", report.latency.percentile_ms(0.95)},
                          {"max", report.latency.max_ms()}};
  }
  json["recording"] = nullptr;
  if (const auto& recording = report.recording) {
    json["recording"] = {{"folder", recording->folder},
                         {"frames", recording->frames},
                         {"dropped", recording->dropped},
                         {"complete", recording->complete}};
  }
  return json;
}

std::string live_text(const LiveReport& report) {
  std::string text = "camera      " + report.camera + "\n";
  if (report.latency.count() > 0) {
    text +=
        line("latency     %.0f ms from a frame to its pose (median), %.0f ms (95 %%), %.0f ms (max)",
             report.latency.percentile_ms(0.5), report.latency.percentile_ms(0.95), report.latency.max_ms());
  }
  if (report.missed + report.unpaired > 0)
    text += line("            %zu colour images never came, %zu came without depth", report.missed,
                 report.unpaired);
  if (report.clock_jumps > 0) text += line("            its clock jumped %zu times", report.clock_jumps);
  if (report.interruptions > 0)
    text +=
        line("            gone or silent %zu times, back %zu times", report.interruptions, report.reconnects);
  if (const auto& recording = report.recording) {
    text += "recording   " + recording->folder + ": " + std::to_string(recording->frames) + " frames";
    if (recording->dropped > 0) text += ", without " + std::to_string(recording->dropped) + " to keep up";
    text += recording->complete ? "\n" : "; ended early\n";
  }
  return text;
}

}  // namespace cpslam::program
