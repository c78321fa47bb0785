#pragma once

#include <vector>

#include "map/map.h"
#include "optim/pose_graph.h"

namespace cpslam {

/// Two keyframes that show the same place, and how they lie to each other.
struct LoopEdge {
  KeyFrameId current;
  KeyFrameId matched;
  SE3 current_from_matched;
};

/// The essential graph (Mur-Artal et al. 2015, III-D) with the ids that lead back into the map.
struct EssentialGraph {
  PoseGraph graph;
  std::vector<KeyFrameId> keyframes;  ///< parallel to graph.cam_from_world
};

/// All keyframes of a session with the edges of the spanning tree, earlier loops and covisibility of at least
/// 100 points, as the map's poses say they lie to each other, and the new loop as measured. The root is
/// fixed. Both ends of the loop must exist and be of the session. The caller holds a shared lock of the map.
[[nodiscard]] EssentialGraph essential_graph(const Map& map, const LoopEdge& loop);

}  // namespace cpslam
