#pragma once

#include <optional>

#include "cpslam/types.h"
#include "map/map.h"
#include "slam/back_end.h"
#include "slam/map_archive.h"
#include "slam/places.h"
#include "slam/rig.h"
#include "slam/tracking.h"
#include "util/log.h"
#include "util/stage_timer.h"

namespace cpslam {

/// A map and all who know its keyframes and points by their ids. System::reset() drops them as one and builds
/// new ones, so that nobody has to forget anything. The destructor stops the threads.
struct LiveMap {
  /// An empty map, or with `begin_loaded` the one of Settings::load_map; throws what load_map() throws.
  /// places: null when places are not recognised. maps_before: numbers of sessions that are taken.
  LiveMap(const Rig& rig, Places* places, bool begin_loaded, int maps_before, StageTimer& timer,
          const Log& log);

  /// Map::sessions_created().
  [[nodiscard]] int sessions_created() const;

  /// Poses of the keyframes that were made here.
  [[nodiscard]] Trajectory keyframe_trajectory() const;

  /// Adds what was made and done in here.
  void add_work_to(Statistics& statistics) const;

  int maps_before;
  Map map;
  std::optional<LoadedMap> loaded;
  Tracking tracking;
  BackEnd back_end;
};

}  // namespace cpslam
