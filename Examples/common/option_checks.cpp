#include "common/option_checks.h"

#include <algorithm>

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

}  // namespace cpslam::program
