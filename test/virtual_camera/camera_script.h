#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace cpslam::virtual_camera {

/// What the virtual camera plays and what goes wrong on the way. Frames are counted from 1 over the driver's
/// whole life, closed and opened devices alike; every fault happens once.
struct CameraScript {
  std::string sequence;                ///< TUM-format folder with a settings.yaml
  std::string settings;                ///< another settings file
  std::optional<double> fps;           ///< absent: the sequence's own intervals
  bool registration = true;            ///< can register depth to colour
  std::uint64_t start_us = 1'000'000;  ///< stamp of the first frame after every opening
  std::optional<int> unplug_after;     ///< frames
  std::optional<double> return_after;  ///< s after it was unplugged; absent: never
  std::optional<int> stall_after;      ///< frames; delivers again once it was closed and opened
  std::optional<int> die_after;        ///< frames; can be opened, and never delivers again
  std::optional<int> jump_after;       ///< frames, from which on the stamps are off by jump_us
  std::int64_t jump_us = 0;
};

/// "key=value;key=value": the members above with '-' for '_'. Throws InputError naming the key.
[[nodiscard]] CameraScript parse_script(const std::string& text);

}  // namespace cpslam::virtual_camera
