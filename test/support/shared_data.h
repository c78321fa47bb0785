#pragma once

#include <cstdlib>
#include <filesystem>

namespace cpslam {

/// Where the recorded clips are, if they are on this machine: the folder CPSLAM_SHARED_DATA, or
/// ../shared/data beside the source.
inline std::filesystem::path shared_data_dir() {
  const char* const variable = std::getenv("CPSLAM_SHARED_DATA");
  return variable != nullptr ? std::filesystem::path(variable)
                             : std::filesystem::path(CPSLAM_SOURCE_DIR) / "../shared/data";
}

}  // namespace cpslam
