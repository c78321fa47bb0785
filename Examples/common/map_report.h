#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cpslam/types.h"

namespace cpslam::program {

/// A loaded map's part of stats.json and of the summary.
[[nodiscard]] nlohmann::ordered_json loaded_map_json(const LoadedMapStatistics& loaded);
[[nodiscard]] std::string loaded_map_text(const LoadedMapStatistics& loaded);

}  // namespace cpslam::program
