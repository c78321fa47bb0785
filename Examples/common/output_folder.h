#pragma once

#include <string>

namespace cpslam::program {

/// Makes a folder for results when it is missing, and refuses early what would only fail when they are
/// written: throws InputError naming the option and the folder.
void prepare_output_folder(const std::string& option, const std::string& folder);

/// Removes the files <stem><digits>.txt of an earlier run, also those with _map<digits>, of which this one
/// may write fewer.
void remove_numbered(const std::string& folder, const std::string& stem);

/// Throws InputError naming the option when a file cannot be written there: its folder is missing or not
/// writable, or it is a folder itself.
void check_writable(const std::string& option, const std::string& file);

}  // namespace cpslam::program
