#include "doctor_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/report_text.h"

namespace cpslam::program {

using diagnosis::Finding;
using diagnosis::Level;

namespace {

std::size_t count(const DoctorReport& report, Level level) {
  return static_cast<std::size_t>(
      std::count_if(report.findings.begin(), report.findings.end(),
                    [level](const Finding& finding) { return finding.level == level; }));
}

std::string count_text(std::size_t n, const char* what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

}  // namespace

std::string to_text(const DoctorReport& report) {
  std::string text = report.source + line(": %zu pairs looked at", report.examined);
  for (const Finding& finding : report.findings) {
    // Texts may be longer than a line() takes.
    text +=
        format_text("%-8s %-19s  ", level_name(finding.level), finding.check.c_str()) + finding.what + "\n";
    if (!finding.advice.empty()) text += format_text("%-8s %-19s  -> ", "", "") + finding.advice + "\n";
  }
  if (report.interrupted) text += "interrupted: this is what was seen until then\n";
  return text + count_text(count(report, Level::kError), "error") + ", " +
         count_text(count(report, Level::kWarning), "warning") + ", " +
         count_text(count(report, Level::kNote), "note") + "\n";
}

std::string to_json(const DoctorReport& report) {
  nlohmann::ordered_json json = {{"version", report.version},
                                 {"source", report.source},
                                 {"settings", nullptr},
                                 {"examined", report.examined},
                                 {"interrupted", report.interrupted},
                                 {"worst", level_name(worst_level(report.findings))}};
  if (!report.settings.empty()) json["settings"] = report.settings;
  json["findings"] = nlohmann::ordered_json::array();
  for (const Finding& finding : report.findings) {
    nlohmann::ordered_json values = nlohmann::ordered_json::object();
    for (const auto& [name, value] : finding.values) values[name] = value;
    json["findings"].push_back({{"level", level_name(finding.level)},
                                {"check", finding.check},
                                {"what", finding.what},
                                {"advice", finding.advice},
                                {"values", values}});
  }
  // File names may hold any bytes.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace cpslam::program
