#pragma once

#include <functional>
#include <string>

#include "common/slam_session.h"
#include "util/run_control.h"

namespace cpslam::program {

/// What the viewer needs to know of a run besides its options.
struct ViewedRun {
  Settings settings;
  std::string ground_truth;  ///< file; where there is none, none is drawn
  bool can_pause = true;     ///< not with a live camera
};

/// Throws InputError when this program was built without the viewer.
void require_viewer();

/// Does a program's work, which feeds the session and looks to the control, and returns its exit code. With
/// --viewer that happens in a thread of its own while the window is shown in the caller's, which has to be
/// the main one: closing the window has the control quit, and when the work is done the window stays until it
/// is closed, by Ctrl-C too. Throws what the work throws, and RunError when the window cannot be shown.
[[nodiscard]] int run_beside_viewer(const SlamOptions& options, const ViewedRun& run, SlamSession& session,
                                    RunControl& control, const std::function<int()>& work);

}  // namespace cpslam::program
