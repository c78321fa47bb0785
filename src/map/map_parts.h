#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "features/frame_features.h"
#include "geometry/se3.h"
#include "map/ids.h"

namespace cpslam {

class Map;

/// A session of a map as plain data that refers to itself by position instead of by id, without what follows
/// from the rest: covisibility, children, what keyframes see, normals, distance ranges and descriptors of
/// points.
struct MapParts {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  struct KeyFramePart {
    std::uint64_t sequence = 0;  ///< ascending
    double time_s = 0.0;
    SE3 cam_from_world;
    std::shared_ptr<const FrameFeatures> features;
    std::uint32_t parent = kNone;  ///< in the spanning tree
  };
  struct ObservationPart {
    std::uint32_t keyframe = kNone;
    std::uint32_t keypoint = kNone;
  };
  struct PointPart {
    Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
    std::vector<ObservationPart> observations;  ///< in the order they were made
    std::uint32_t reference = kNone;            ///< the keyframe whose observation sets the distance range
    std::uint64_t first_sequence = 0;           ///< of the keyframe that made the point
    std::uint32_t visible = 0;
    std::uint32_t found = 0;
  };
  /// A frame that was tracked, by its pose relative to a keyframe.
  struct FramePart {
    double time_s = 0.0;
    std::uint32_t keyframe = kNone;
    SE3 cam_from_keyframe;
  };

  std::vector<KeyFramePart> keyframes;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> loops;  ///< each once, the older keyframe first
  std::vector<PointPart> points;
  std::vector<FramePart> frames;        ///< in the order they came
  std::uint64_t keyframes_created = 0;  ///< in all sessions of the map
  std::uint64_t points_created = 0;     ///< likewise
};

/// The parts of a session, without frames, which a Map does not know. The caller holds a shared lock of the
/// map.
[[nodiscard]] MapParts take_apart(const Map& map, int session = 1);

/// Throws InputError that says which part is none: a pose that is not rigid, a number that is not finite, a
/// reference to nothing, a circle in the spanning tree, a keypoint that sees two points. What passes is safe
/// to work with, whoever wrote it. n_levels: of the pyramid.
void check(const MapParts& parts, int n_levels);

/// Throws InputError when sessions that have passed check() do not make one map: sequences are given out once
/// in a map, and the session whose first keyframe is older comes first.
void check_sequences(const std::vector<MapParts>& sessions);

}  // namespace cpslam
