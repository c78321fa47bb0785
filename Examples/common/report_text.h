#pragma once

#include <string>

#include "cpslam/types.h"
#include "util/format_text.h"

namespace cpslam::program {

/// A line of a report, by a format of printf's.
template <typename... Values>
[[nodiscard]] std::string line(const char* format, Values... values) {
  return format_text(format, values...) + "\n";
}

/// Null when the stage was never measured.
[[nodiscard]] inline const StageTimes* find_stage(const Statistics& statistics, const std::string& name) {
  for (const StageTimes& stage : statistics.stages) {
    if (stage.stage == name) return &stage;
  }
  return nullptr;
}

}  // namespace cpslam::program
