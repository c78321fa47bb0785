#include "common/option_checks.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <system_error>

namespace cpslam::program {

std::string check_count(const std::string& text) {
  const bool whole =
      !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return whole ? std::string() : "'" + text + "' is not a whole number of at least 0";
}

std::string check_positive_count(const std::string& text) {
  const bool zero = text.find_first_not_of('0') == std::string::npos;
  return zero ? "must be at least 1, not " + text : check_count(text);
}

std::function<std::string(const std::string&)> check_range(double lowest, double highest) {
  return [lowest, highest](const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool number = error == std::errc() && end == text.data() + text.size();
    if (number && value >= lowest && value <= highest) return std::string();
    std::array<char, 80> range{};
    std::snprintf(range.data(), range.size(), "%g to %g", lowest, highest);
    return "'" + text + "' is not a number in " + range.data();
  };
}

}  // namespace cpslam::program
