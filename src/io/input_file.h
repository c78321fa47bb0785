#pragma once

#include <string>

namespace cpslam {

/// The bytes of a whole file. Throws InputError that names the file when it is missing, a folder, not
/// readable or empty.
[[nodiscard]] std::string read_input_file(const std::string& path);

/// The same for a file that must be a regular one: a device may go on for ever. kind is for the message:
/// "vocabulary".
[[nodiscard]] std::string read_regular_file(const std::string& path, const std::string& kind);

}  // namespace cpslam
