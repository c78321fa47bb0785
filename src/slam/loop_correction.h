#pragma once

#include <atomic>
#include <optional>

#include "map/map.h"
#include "slam/loop_verification.h"
#include "slam/rig.h"
#include "util/stage_timer.h"

namespace cpslam {

/// What closing a loop changed.
struct ClosedLoop {
  double distance_m = 0.0;  ///< by which, the loop says, its current keyframe was off
  double angle_rad = 0.0;
  int joined_session = 0;  ///< number of the session that became part of the other; 0: both ends were of one
};

/// Closes a loop: optimises the poses of the essential graph with the loop's edge, moves keyframes and points
/// there in one step, and makes one of the points that the two sides of the loop have twice. The graph is
/// solved on a snapshot; the map is locked only to copy and to write, each time for short. Of a loop between
/// two sessions the younger moves as a whole (Map::join_sessions), where the graph would move it, too:
/// nothing else connects them. Nobody else may move keyframes meanwhile; new ones may come. Nothing happens,
/// and nothing is returned, when an end of the loop is gone or the flag is raised before the map is moved.
std::optional<ClosedLoop> close_loop(const Rig& rig, Map& map, const VerifiedLoop& loop, StageTimer& timer,
                                     const std::atomic<bool>& abort);

}  // namespace cpslam
