#pragma once

#include "cpslam/types.h"

namespace cpslam {

/// Adds what became of a frame to the statistics.
void count_frame(const TrackResult& result, Statistics& counts);

/// Adds a frame that was looked for in a loaded map.
void count_frame(const TrackResult& result, LoadedMapStatistics& loaded);

}  // namespace cpslam
