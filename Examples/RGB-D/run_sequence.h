#pragma once

#include <vector>

#include "common/picture_writer.h"
#include "common/progress_bar.h"
#include "common/run_report.h"
#include "cpslam/system.h"
#include "io/tum_sequence.h"

namespace cpslam::program {

/// Feeds a sequence to a System until its end, Ctrl-C or a failure that is not one frame's; pictures (null:
/// none) get every frame that was tracked. Returns an exit code and fills the report's counts. Whatever
/// fails, the system keeps what it has.
[[nodiscard]] int run_sequence(System& system, const std::vector<RgbdEntry>& entries, ProgressBar& bar,
                               PictureWriter* pictures, RunReport& report);

}  // namespace cpslam::program
