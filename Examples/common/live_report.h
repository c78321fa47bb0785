#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "util/stage_timer.h"

namespace cpslam::program {

/// What a run that recorded its frames wrote.
struct RecordingReport {
  std::string folder;
  std::size_t frames = 0;
  std::size_t dropped = 0;  ///< not written, because too many were waiting
  bool complete = true;     ///< false: a frame could not be written, and that was the end of it
};

/// What a run on a camera, or on a file recorded from one, leaves behind besides the rest.
struct LiveReport {
  std::string camera;
  std::size_t missed = 0;         ///< colour images the camera numbered that never came
  std::size_t unpaired = 0;       ///< colour images without depth
  std::size_t clock_jumps = 0;    ///< of the camera's clock
  std::size_t interruptions = 0;  ///< the camera was gone or silent
  std::size_t reconnects = 0;     ///< and came back
  DurationHistogram latency;      ///< from a frame's own time to its pose; nothing for files
  std::optional<RecordingReport> recording;
};

/// The parts of stats.json and of the summary that are about the camera.
[[nodiscard]] nlohmann::ordered_json live_json(const LiveReport& report);
[[nodiscard]] std::string live_text(const LiveReport& report);

}  // namespace cpslam::program
