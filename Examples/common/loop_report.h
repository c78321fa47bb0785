#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "common/run_report.h"

namespace cpslam::program {

/// Whether the run looked for loops.
[[nodiscard]] bool has_loops(const RunReport& report);

/// The parts of stats.json and of the summary that are about loops, when has_loops().
[[nodiscard]] nlohmann::ordered_json loops_json(const Statistics& statistics);
[[nodiscard]] std::string loops_text(const Statistics& statistics);

[[nodiscard]] nlohmann::ordered_json loop_settings_json(const LoopSettings& settings);

}  // namespace cpslam::program
