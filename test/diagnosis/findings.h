#pragma once

#include <gtest/gtest.h>

#include <string>

#include "diagnosis/finding.h"

namespace cpslam::diagnosis {

/// The worst finding of a check; an empty one, and a failed test, when the check said nothing.
inline Finding worst_of(const Findings& findings, const std::string& check) {
  const Finding* worst = nullptr;
  for (const Finding& finding : findings) {
    if (finding.check == check && (worst == nullptr || finding.level > worst->level)) worst = &finding;
  }
  if (worst != nullptr) return *worst;
  ADD_FAILURE() << "nothing about " << check;
  return {};
}

/// A value of any finding of a check.
inline double value_of(const Findings& findings, const std::string& check, const std::string& name) {
  for (const Finding& finding : findings) {
    if (finding.check != check) continue;
    for (const auto& [its_name, value] : finding.values) {
      if (its_name == name) return value;
    }
  }
  ADD_FAILURE() << check << " has no " << name;
  return 0.0;
}

/// All findings above a level, as text for failed tests.
inline std::string texts_above(const Findings& findings, Level level) {
  std::string text;
  for (const Finding& finding : findings) {
    if (finding.level > level) text += finding.check + ": " + finding.what + "\n";
  }
  return text;
}

}  // namespace cpslam::diagnosis
