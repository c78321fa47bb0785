#include "common/console_log.h"

namespace cpslam::program {

LogSink console_log(ProgressBar& bar, bool quiet) {
  return [&bar, quiet](LogLevel level, const std::string& message) {
    switch (level) {
      case LogLevel::kDebug:
        break;
      case LogLevel::kInfo:
        if (!quiet) bar.print_line(message);
        break;
      case LogLevel::kWarning:
        bar.print_line("warning: " + message);
        break;
      case LogLevel::kError:
        bar.print_line("error: " + message);
        break;
    }
  };
}

}  // namespace cpslam::program
