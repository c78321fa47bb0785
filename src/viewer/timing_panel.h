#pragma once

#include "viewer/gui.h"
#include "viewer/timing_history.h"

namespace cpslam::viewer {

/// A column per frame, stacked by what its time was spent on, and the stages' percentiles below. Lays out in
/// the current ImGui window.
void draw_timings(const Gui& gui, const TimingHistory& history);

}  // namespace cpslam::viewer
