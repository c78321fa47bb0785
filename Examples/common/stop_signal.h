#pragma once

namespace cpslam::program {

/// Makes Ctrl-C (SIGINT) and SIGTERM set a flag instead of ending the program, so that what was tracked is
/// saved; a second Ctrl-C ends it at once.
void install_stop_signal();

[[nodiscard]] bool stop_requested();

}  // namespace cpslam::program
