#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "detect/darknet_config.h"

namespace cpslam {

/// Reads one section and writes down what it has read, in one spelling and with Darknet's defaults filled in:
/// OpenCV's own defaults differ, and it is to get nothing that was not checked. The getters throw InputError
/// naming file and line.
class DarknetTranscript {
 public:
  /// Throws InputError when the section has a key that changes what its layer computes or how many weights it
  /// has, and that OpenCV does not know.
  explicit DarknetTranscript(const DarknetSection& section);

  int required(std::string_view key, int lowest, int highest);
  int optional(std::string_view key, int fallback, int lowest, int highest);
  double optional_number(std::string_view key, double fallback, double lowest, double highest);
  std::vector<int> required_ints(std::string_view key, int lowest, int highest);
  std::vector<double> required_numbers(std::string_view key, double lowest, double highest);
  /// One of those that Darknet and OpenCV share; no fallback: the key must be there.
  void activation(std::string_view fallback = {});
  void write(std::string_view key, std::string_view value);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  const DarknetSection* section_;
  std::string text_;
};

}  // namespace cpslam
