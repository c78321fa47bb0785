#pragma once

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace cpslam::program {

/// Makes a folder for results when it is missing, and refuses early what would only fail when they are
/// written: throws InputError naming the option and the folder.
void prepare_output_folder(const std::string& option, const std::string& folder);

/// The files in a folder whose names match a pattern in full; none where it cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> find_files(const std::string& folder,
                                                            const std::regex& name);

/// Throws InputError naming the option when a file cannot be written there: its folder is missing or not
/// writable, or it is a folder itself.
void check_writable(const std::string& option, const std::string& file);

}  // namespace cpslam::program
