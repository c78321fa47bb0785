#pragma once

#include <functional>
#include <string>

namespace cpslam::program {

/// Checks for CLI11 options: an empty text when the value will do, else why not. Whole numbers only: CLI11
/// alone would turn -1 into a very large count.
[[nodiscard]] std::string check_count(const std::string& text);
[[nodiscard]] std::string check_positive_count(const std::string& text);

/// A check that a value is a number in a range, which CLI11's takes nan for.
[[nodiscard]] std::function<std::string(const std::string&)> check_range(double lowest, double highest);

}  // namespace cpslam::program
