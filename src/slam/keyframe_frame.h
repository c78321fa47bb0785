#pragma once

#include <optional>

#include "map/map.h"
#include "slam/frame.h"

namespace cpslam {

/// A keyframe as a frame that is to be placed anew: its features and its pose, without matches. Nothing when
/// it is gone. Takes a shared lock of the map.
[[nodiscard]] std::optional<Frame> keyframe_as_frame(const Map& map, KeyFrameId id);

}  // namespace cpslam
