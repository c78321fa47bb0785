#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cpslam/types.h"
#include "map/map.h"
#include "slam/places.h"
#include "slam/rig.h"
#include "slam/trajectory_log.h"
#include "util/log.h"

namespace cpslam {

/// What came with a loaded map besides its keyframes and points.
struct LoadedMap {
  std::vector<LoggedFrame> frames;  ///< that were tracked while it was made
  std::uint64_t next_sequence = 0;  ///< KeyFrame::sequence from which on keyframes are new
  LoadedMapStatistics statistics;
};

/// Fills the empty map from the file Settings::load_map and has places remember its keyframes, by words found
/// anew in their descriptors, whatever words the map was made with. The file's sessions keep their order and
/// are numbered from 1. Nothing without such a file. Throws what load_map_file() throws, and InputError for a
/// file without any. One thread may work with the map.
[[nodiscard]] std::optional<LoadedMap> load_map(const Rig& rig, Map& map, Places* places, const Log& log);

/// Writes all sessions of the map and the frames that hang on them; a frame of a culled keyframe hangs on its
/// nearest living ancestor from then on. places: null when places are not recognised. Throws RunError that
/// names the file and the cause, also when there is no map yet. Takes a shared lock of the map to copy it.
void save_map(const std::string& path, const Rig& rig, const Map& map, const Places* places,
              const std::vector<LoggedFrame>& frames);

}  // namespace cpslam
