#pragma once

#include <cstddef>
#include <string>

#include "diagnosis/finding.h"

namespace cpslam::program {

/// What cpslam_doctor found out.
struct DoctorReport {
  std::string version;
  std::string source;    ///< folder, camera or file
  std::string settings;  ///< file; empty: none
  std::size_t examined = 0;
  bool interrupted = false;
  diagnosis::Findings findings;
};

/// Two lines a finding: what, and what to do; a summary at the end.
[[nodiscard]] std::string to_text(const DoctorReport& report);
[[nodiscard]] std::string to_json(const DoctorReport& report);

}  // namespace cpslam::program
