#pragma once

#include <array>
#include <cstdio>
#include <string>

#include "cpslam/types.h"

namespace cpslam::program {

/// A line of a report, by a format of printf's.
template <typename... Values>
[[nodiscard]] std::string line(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return std::string(text.data()) + "\n";
}

/// Null when the stage was never measured.
[[nodiscard]] inline const StageTimes* find_stage(const Statistics& statistics, const std::string& name) {
  for (const StageTimes& stage : statistics.stages) {
    if (stage.stage == name) return &stage;
  }
  return nullptr;
}

}  // namespace cpslam::program
