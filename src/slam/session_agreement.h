#pragma once

#include "map/map.h"
#include "slam/essential_graph.h"
#include "slam/rig.h"

namespace cpslam {

/// How two sessions agree when a loop lays one over the other: told from keyframes of the one that then stand
/// beside keyframes of the other and look the same way.
struct SessionAgreement {
  int agreeing = 0;       ///< find what the other session has there
  int contradicting = 0;  ///< should find it, and do not
  double span_m = 0.0;    ///< the longest way between two that agree; turns count, too
};

/// Lays the sessions of the loop's two ends over each other and compares them wherever both have looked.
/// Takes shared locks of the map.
[[nodiscard]] SessionAgreement compare_sessions(const Rig& rig, const Map& map, const LoopEdge& loop);

/// Whether two sessions may be joined. Nothing of the way between their worlds is known, so that what tells
/// two like places apart within a session (is_plausible()) tells nothing here; what does is the surroundings.
[[nodiscard]] bool is_enough(const SessionAgreement& agreement);

}  // namespace cpslam
