#pragma once

#include <optional>

#include "map/map.h"
#include "slam/essential_graph.h"

namespace cpslam {

/// Length of the shortest way between two keyframes through covisibility graph, spanning tree and loops: what
/// odometry had to be carried along, and drifted over. Turning counts too. Nothing when they are not
/// connected. The caller holds a shared lock of the map.
[[nodiscard]] std::optional<double> chain_length_m(const Map& map, KeyFrameId from, KeyFrameId to);

/// Whether the loop's ends lie so near to where the map has them that drift along the chain between them can
/// account for the rest. Where two places look the same (two identical desks in a room), nothing else tells
/// that they are not. Keyframes that are not connected know nothing of each other: anything is plausible
/// (between sessions, see compare_sessions()). The caller holds a shared lock of the map; both ends exist.
[[nodiscard]] bool is_plausible(const Map& map, const LoopEdge& loop);

}  // namespace cpslam
