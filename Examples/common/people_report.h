#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "common/run_report.h"

namespace cpslam::program {

/// A detector, or boxes from elsewhere, took part in the run.
[[nodiscard]] bool has_people(const RunReport& report);

/// The parts of stats.json and of the summary that are about people, when has_people().
[[nodiscard]] nlohmann::ordered_json people_json(const RunReport& report);
[[nodiscard]] std::string people_text(const RunReport& report);

[[nodiscard]] nlohmann::ordered_json detector_settings_json(const Settings& settings);
[[nodiscard]] nlohmann::ordered_json people_settings_json(const PeopleSettings& settings);

}  // namespace cpslam::program
