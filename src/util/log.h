#pragma once

#include <string>
#include <utility>

#include "cpslam/log.h"

namespace cpslam {

/// Thin front of a LogSink: no global state, cheap to copy.
class Log {
 public:
  Log() = default;
  explicit Log(LogSink sink) : sink_(std::move(sink)) {}
  void debug(const std::string& message) const { write(LogLevel::kDebug, message); }
  void info(const std::string& message) const { write(LogLevel::kInfo, message); }
  void warning(const std::string& message) const { write(LogLevel::kWarning, message); }
  void error(const std::string& message) const { write(LogLevel::kError, message); }

 private:
  void write(LogLevel level, const std::string& message) const {
    if (sink_) sink_(level, message);
  }
  LogSink sink_;
};

}  // namespace cpslam
