#pragma once

#include <string>

namespace cpslam {

/// The bytes of a whole file. Throws InputError that names the file when it is missing, a folder, not
/// readable or empty.
[[nodiscard]] std::string read_input_file(const std::string& path);

}  // namespace cpslam
