#pragma once

#include <OpenNI.h>

#include <string>

namespace cpslam {

/// "640x480 at 30/s"
[[nodiscard]] std::string mode_text(int width, int height, int fps);

/// The mode of a sensor of this size and rate whose pixels we read with the least effort. Throws InputError
/// naming what (as "colour") and the sizes and rates that there are.
[[nodiscard]] openni::VideoMode choose_mode(const openni::SensorInfo& sensor, const std::string& what,
                                            int width, int height, int fps);

/// Units of depth per metre; 0 for pixels that are no depths.
[[nodiscard]] double units_per_metre(openni::PixelFormat format);

}  // namespace cpslam
