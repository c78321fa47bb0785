#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cpslam {

/// Where the files that come with CP-SLAM may lie, best first: the executable's folder, the installation it
/// belongs to and the one this library was configured for (share/cpslam), the folder the environment variable
/// CPSLAM_DATA names. Not all of them exist.
[[nodiscard]] std::vector<std::string> data_folders();

/// The first folder below which all of these files are ("models/yc.cfg"), so that files of one set are never
/// taken from two installations.
[[nodiscard]] std::optional<std::string> find_data_folder(const std::vector<std::string>& folders,
                                                          const std::vector<std::string>& files);

/// Path of one bundled file in data_folders(); empty when it is in none.
[[nodiscard]] std::optional<std::string> find_bundled_file(const std::string& file);

/// "'models/yc.weights' is not in 'A', 'B' or 'C'", the data_folders(): for messages.
[[nodiscard]] std::string not_bundled_text(const std::string& file);

}  // namespace cpslam
