#pragma once

#include <cstddef>
#include <string>

#include "util/log.h"

namespace cpslam {

/// Logs the first few messages of a kind as errors and only counts the others, so that what fails at every
/// frame does not drown the rest. Not thread-safe.
class CountedMessages {
 public:
  static constexpr std::size_t kShown = 3;

  explicit CountedMessages(Log log) : log_(std::move(log)) {}

  void error(const std::string& message) {
    if (++count_ > kShown) return;
    log_.error(message + (count_ == kShown ? " (more of this is only counted)" : ""));
  }

 private:
  Log log_;
  std::size_t count_ = 0;
};

}  // namespace cpslam
