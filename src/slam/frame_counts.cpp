#include "slam/frame_counts.h"

namespace cpslam {

void count_frame(const TrackResult& result, Statistics& counts) {
  ++counts.frames;
  if (result.bridged) ++counts.bridged;
  switch (result.state) {
    case TrackingState::kWeak:
      ++counts.weak;
      [[fallthrough]];
    case TrackingState::kTracked:
      ++counts.tracked;
      break;
    case TrackingState::kPredicted:
      ++counts.predicted;
      break;
    case TrackingState::kLost:
      ++counts.lost;
      break;
    case TrackingState::kNotInitialized:
      ++counts.not_initialized;
      break;
  }
}

void count_frame(const TrackResult& result, LoadedMapStatistics& loaded) {
  if (loaded.found_time_s) return;
  if (is_tracked(result.state)) {
    loaded.found_time_s = result.time_s;
  } else {
    ++loaded.frames_before_found;
  }
}

}  // namespace cpslam
