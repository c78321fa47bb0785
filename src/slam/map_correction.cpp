#include "slam/map_correction.h"

#include <vector>

namespace cpslam {
namespace {

struct Move {
  KeyFrameId keyframe;
  SE3 cam_from_world;  // the new one
  SE3 new_from_old;    // of the world around the keyframe
};

Move move_of(const Map& map, const MapCorrection& correction, KeyFrameId id) {
  const KeyFrame& keyframe = *map.keyframe(id);
  KeyFrameId known = id;
  while (known.valid() && !correction.cam_from_world.contains(known)) known = map.keyframe(known)->parent;
  if (!known.valid()) return {id, keyframe.cam_from_world, {}};
  const SE3& corrected = correction.cam_from_world.at(known);
  const SE3 new_from_old = corrected.inverse() * map.keyframe(known)->cam_from_world;
  if (known == id) return {id, corrected, new_from_old};
  return {id, (keyframe.cam_from_world * new_from_old.inverse()).normalized(), new_from_old};
}

}  // namespace

void apply_correction(Map& map, const MapCorrection& correction) {
  std::vector<Move> moves;
  std::vector<std::size_t> move_of_slot;
  for (const KeyFrameId id : map.keyframes_by_sequence()) {
    if (move_of_slot.size() <= id.index) move_of_slot.resize(id.index + std::size_t{1});
    move_of_slot[id.index] = moves.size();
    moves.push_back(move_of(map, correction, id));
  }
  for (const Move& move : moves) map.set_pose(move.keyframe, move.cam_from_world);
  for (const MapPointId id : map.point_ids()) {
    const MapPoint& point = *map.point(id);
    const auto given = correction.point_in_world.find(id);
    map.set_position(id,
                     given != correction.point_in_world.end()
                         ? given->second
                         : moves[move_of_slot[point.reference.index]].new_from_old * point.position_in_world);
    map.refresh_geometry(id);
  }
  map.count_correction();
}

}  // namespace cpslam
