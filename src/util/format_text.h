#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace cpslam {

/// A piece of a report or message by a format of printf's, at most 255 characters.
template <typename... Values>
[[nodiscard]] std::string format_text(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace cpslam
