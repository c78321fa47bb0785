#pragma once

#include "common/progress_bar.h"
#include "cpslam/log.h"

namespace cpslam::program {

/// A LogSink that writes "warning: ..." lines to stderr without tearing the progress bar apart; quiet keeps
/// warnings and errors only. Thread-safe. The bar must outlive the sink.
[[nodiscard]] LogSink console_log(ProgressBar& bar, bool quiet);

}  // namespace cpslam::program
