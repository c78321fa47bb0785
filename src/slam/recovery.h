#pragma once

#include <optional>
#include <vector>

#include "map/map.h"
#include "slam/frame.h"
#include "slam/places.h"
#include "slam/rig.h"
#include "slam/word_matching.h"
#include "util/random.h"

namespace cpslam {

/// Tries to place a frame against one keyframe by appearance alone, with no predicted pose. With the direct
/// indices of frame and keyframe only features under the same node are compared, else all with all. On
/// success the frame has a pose and matches with the keyframe's points; returns their number, else 0 and the
/// frame has no matches. Takes a shared lock of the map.
int recover_from_keyframe(const Rig& rig, const Map& map, KeyFrameId keyframe, Random& random, Frame& frame,
                          const std::optional<IndexPair>& indices = std::nullopt);

/// Keyframes that may show what a frame shows, best first: those around the reference keyframe and the latest
/// ones, where tracking was a moment ago, then the places that look alike. Without places (null) only the
/// former. Takes a shared lock of the map.
[[nodiscard]] std::vector<KeyFrameId> recovery_candidates(const Map& map, const Places* places,
                                                          KeyFrameId reference, const BowVector& bow);

}  // namespace cpslam
