#include "slam/live_map.h"

#include <shared_mutex>
#include <utility>

#include "slam/trajectory_log.h"

namespace cpslam {

LiveMap::LiveMap(const Rig& rig, Places* places, bool begin_loaded, int number, StageTimer& timer,
                 const Log& log)
    : maps_before(number),
      map(rig.pyramid, number),
      loaded(begin_loaded ? load_map(rig, map, places, log) : std::nullopt),
      tracking(rig, map, places, timer, log, loaded ? std::move(loaded->frames) : std::vector<LoggedFrame>()),
      back_end(rig, map, places, timer, log) {}

int LiveMap::sessions_created() const {
  const std::shared_lock lock(map.mutex());
  return map.sessions_created();
}

Trajectory LiveMap::keyframe_trajectory() const {
  return keyframe_poses(map, loaded ? loaded->next_sequence : 0);
}

void LiveMap::add_work_to(Statistics& statistics) const {
  statistics.local_bundle_adjustments += back_end.local_bundle_adjustments();
  const LoopStatistics loops = back_end.loop_statistics();
  LoopStatistics& all = statistics.loops;
  all.events.insert(all.events.end(), loops.events.begin(), loops.events.end());
  all.full_bundle_adjustments += loops.full_bundle_adjustments;
  all.full_bundle_adjustments_given_up += loops.full_bundle_adjustments_given_up;
  const std::shared_lock lock(map.mutex());
  statistics.keyframes_created += map.keyframes_created();
  statistics.map_points_created += map.points_created();
  const int loaded_maps = loaded ? static_cast<int>(loaded->statistics.maps) : 0;
  statistics.maps_started += static_cast<std::size_t>(map.sessions_created() - maps_before - loaded_maps);
}

}  // namespace cpslam
