#pragma once

#include <string>
#include <utility>
#include <vector>

namespace cpslam::diagnosis {

/// How bad a finding is, in growing order.
enum class Level {
  kOk,
  kNote,     ///< good to know
  kWarning,  ///< SLAM will run and be worse for it
  kError,    ///< SLAM will fail, or be wrong without a word
};

/// "ok", "note", "warning" or "error".
[[nodiscard]] const char* level_name(Level level);

/// What one check has to say, for people and, in `values`, for programs.
struct Finding {
  Level level = Level::kOk;
  std::string check;                                   ///< "time offset"; several findings may share one
  std::string what;                                    ///< one line with the number
  std::string advice;                                  ///< one line: what to do; empty when there is nothing
  std::vector<std::pair<std::string, double>> values;  ///< names carry units: "offset_s"
};

using Findings = std::vector<Finding>;

/// kOk for none.
[[nodiscard]] Level worst_level(const Findings& findings);

}  // namespace cpslam::diagnosis
