#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cpslam/types.h"

namespace cpslam::program {

/// A loaded map's part of stats.json and of the summary.
[[nodiscard]] nlohmann::ordered_json loaded_map_json(const LoadedMapStatistics& loaded);
[[nodiscard]] std::string loaded_map_text(const LoadedMapStatistics& loaded);

/// The maps of a run, likewise; no text where there was but one.
[[nodiscard]] nlohmann::ordered_json maps_json(const Statistics& statistics);
[[nodiscard]] std::string maps_text(const Statistics& statistics);

}  // namespace cpslam::program
