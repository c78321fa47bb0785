#pragma once

#include <string>

namespace cpslam::program {

/// Checks for CLI11 options: an empty text when the value will do, else why not. Whole numbers only: CLI11
/// alone would turn -1 into a very large count.
[[nodiscard]] std::string check_count(const std::string& text);
[[nodiscard]] std::string check_positive_count(const std::string& text);

}  // namespace cpslam::program
