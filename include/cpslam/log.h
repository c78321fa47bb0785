#pragma once

#include <functional>
#include <string>

namespace cpslam {

enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// Receives every message of the library. Called from any of the library's threads, so it must be
/// thread-safe; it must not call back into the library. An empty sink drops the messages.
using LogSink = std::function<void(LogLevel, const std::string& message)>;

}  // namespace cpslam
