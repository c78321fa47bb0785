#include "slam/map_archive.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <utility>

#include "cpslam/error.h"
#include "map/map_file.h"

namespace cpslam {
namespace {

void add_session(const MapParts& parts, const std::vector<KeyFrameId>& ids, LoadedMap& loaded) {
  for (const MapParts::FramePart& part : parts.frames) {
    loaded.frames.push_back({part.time_s, ids[part.keyframe], part.cam_from_keyframe});
  }
  loaded.next_sequence = std::max(loaded.next_sequence, parts.keyframes_created);
  ++loaded.statistics.maps;
  loaded.statistics.keyframes += parts.keyframes.size();
  loaded.statistics.points += parts.points.size();
}

/// The frames of a session by what is alive of the keyframes they hang on. The caller holds a shared lock of
/// the map.
std::vector<MapParts::FramePart> frame_parts(const Map& map, const std::vector<LoggedFrame>& frames,
                                             int session) {
  std::map<KeyFrameId, std::uint32_t> positions;
  for (const KeyFrameId id : map.keyframes_by_sequence()) {
    if (map.keyframe(id)->session == session)
      positions.emplace(id, static_cast<std::uint32_t>(positions.size()));
  }
  std::vector<MapParts::FramePart> parts;
  for (const LoggedFrame& frame : frames) {
    const KeyFrameId living = map.living(frame.reference);
    const auto reference_from_world = map.cam_from_world(frame.reference);
    if (!positions.contains(living) || !reference_from_world) continue;
    MapParts::FramePart part{frame.time_s, positions.at(living), frame.cam_from_reference};
    if (living != frame.reference) {
      const SE3 world_from_living = map.keyframe(living)->cam_from_world.inverse();
      part.cam_from_keyframe =
          (frame.cam_from_reference * *reference_from_world * world_from_living).normalized();
    }
    parts.push_back(part);
  }
  return parts;
}

void tell(const std::string& path, const LoadedMapStatistics& loaded, const Log& log) {
  const std::string maps = loaded.maps > 1 ? std::to_string(loaded.maps) + " maps, " : "";
  log.info("map '" + path + "' loaded: " + maps + std::to_string(loaded.keyframes) + " keyframes, " +
           std::to_string(loaded.points) + " points");
  if (loaded.other_vocabulary)
    log.info("the map was made with another vocabulary; the words of its keyframes have been found anew");
}

}  // namespace

std::optional<LoadedMap> load_map(const Rig& rig, Map& map, Places* places, const Log& log) {
  const std::string& path = rig.settings.load_map;
  if (path.empty()) return std::nullopt;
  const MapFile file = load_map_file(path, rig.settings.camera, rig.settings.orb);
  if (file.sessions.empty()) throw InputError("'" + path + "': there is no map in it");
  LoadedMap loaded;
  for (const MapParts& parts : file.sessions) {
    std::vector<KeyFrameId> ids;
    {
      const std::unique_lock lock(map.mutex());
      ids = map.assemble(parts);
    }
    add_session(parts, ids, loaded);
    if (places == nullptr) continue;
    for (const KeyFrameId id : ids) places->remember(map, id);
  }
  if (places != nullptr)
    loaded.statistics.other_vocabulary = file.vocabulary && *file.vocabulary != places->vocabulary.identity();
  tell(path, loaded.statistics, log);
  return loaded;
}

void save_map(const std::string& path, const Rig& rig, const Map& map, const Places* places,
              const std::vector<LoggedFrame>& frames) {
  MapFile file;
  file.camera = rig.settings.camera;
  file.orb = rig.settings.orb;
  if (places != nullptr) file.vocabulary = places->vocabulary.identity();
  {
    const std::shared_lock lock(map.mutex());
    if (map.n_keyframes() == 0) throw RunError("'" + path + "' was not written: there is no map to save");
    for (const int session : map.sessions()) {
      file.sessions.push_back(take_apart(map, session));
      file.sessions.back().frames = frame_parts(map, frames, session);
    }
  }
  save_map_file(path, file);
}

}  // namespace cpslam
