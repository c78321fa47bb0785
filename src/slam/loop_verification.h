#pragma once

#include <optional>
#include <vector>

#include "map/map.h"
#include "slam/essential_graph.h"
#include "slam/frame.h"
#include "slam/rig.h"
#include "slam/word_matching.h"
#include "util/random.h"

namespace cpslam {

/// A loop that geometry confirms.
struct VerifiedLoop {
  LoopEdge edge;
  std::vector<PointMatch>
      matches;      ///< parallel to the current keyframe's keypoints: points of the other side
  int inliers = 0;  ///< among them
};

/// Whether the current keyframe really shows the candidate's place: RANSAC over rigid alignments (depth fixes
/// the scale), then guided search for all points around the candidate. Enough of those that should be visible
/// must agree, spread so that they determine the pose. Within a session drift must be able to account for it
/// (see is_plausible()); two sessions must agree wherever both have looked (see is_enough()). indices: of the
/// current keyframe and the candidate. Takes shared locks of the map.
[[nodiscard]] std::optional<VerifiedLoop> verify_loop(const Rig& rig, const Map& map, KeyFrameId current,
                                                      KeyFrameId candidate, const IndexPair& indices,
                                                      Random& random);

}  // namespace cpslam
