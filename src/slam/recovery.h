#pragma once

#include <optional>

#include "map/map.h"
#include "slam/frame.h"
#include "slam/rig.h"
#include "slam/word_matching.h"
#include "util/random.h"

namespace cpslam {

/// Tries to place a frame against one keyframe by appearance alone, with no predicted pose. On success the
/// frame has a pose and matches with the keyframe's points; returns their number, else 0 and the frame has no
/// matches. With the direct indices of both, only keypoints under the same node are compared: quicker by far.
/// Takes a shared lock of the map.
int recover_from_keyframe(const Rig& rig, const Map& map, KeyFrameId keyframe, Random& random, Frame& frame,
                          const std::optional<IndexPair>& indices = std::nullopt);

/// Keyframes worth trying, best first: the reference, the latest, those around the reference, then older ones
/// in turn (attempt counts the frames since tracking was lost, so that in time all are tried). Takes a shared
/// lock.
[[nodiscard]] std::vector<KeyFrameId> recovery_candidates(const Map& map, KeyFrameId reference,
                                                          std::size_t attempt);

}  // namespace cpslam
