#pragma once

#include <vector>

#include "common/progress_bar.h"
#include "common/run_report.h"
#include "common/slam_session.h"
#include "io/tum_sequence.h"
#include "util/run_control.h"

namespace cpslam::program {

/// Feeds a sequence to a session until its end, Ctrl-C, the control's or a failure that is not one frame's.
/// Returns an exit code and fills the report's counts. Whatever fails, the session keeps what it has.
[[nodiscard]] int run_sequence(SlamSession& session, const std::vector<RgbdEntry>& entries,
                               RunControl& control, ProgressBar& bar, RunReport& report);

}  // namespace cpslam::program
