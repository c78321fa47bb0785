#include "slam/map_counts.h"

#include <algorithm>
#include <map>
#include <shared_mutex>

namespace cpslam {

std::vector<MapCounts> count_maps(const Map& map, const Trajectory& frames) {
  std::map<int, MapCounts> by_number;
  for (const StampedPose& frame : frames) ++by_number[frame.map].frames;
  {
    const std::shared_lock lock(map.mutex());
    for (const KeyFrameId id : map.keyframes_by_sequence()) ++by_number[map.keyframe(id)->session].keyframes;
  }
  std::vector<MapCounts> maps;
  for (auto& [number, counts] : by_number) {
    counts.map = number;
    maps.push_back(counts);
  }
  std::stable_sort(maps.begin(), maps.end(),
                   [](const MapCounts& a, const MapCounts& b) { return a.frames > b.frames; });
  return maps;
}

}  // namespace cpslam
