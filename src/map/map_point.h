#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "features/descriptor.h"
#include "map/ids.h"

namespace cpslam {

/// Which keypoint of which keyframe sees a point.
struct Observation {
  KeyFrameId keyframe;
  int keypoint = -1;
};

/// A point of the map. Plain data: Map keeps the links between keyframes and points consistent.
struct MapPoint {
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal =
      Eigen::Vector3d::Zero();  ///< mean unit direction from the observing cameras to the point
  Descriptor descriptor;        ///< the observed one that is nearest to all others
  float min_distance_m = 0.0F;  ///< range of distances at which the pyramid can show the point
  float max_distance_m = 0.0F;
  KeyFrameId reference;                   ///< whose observation sets the distance range
  std::vector<Observation> observations;  ///< in the order they were made, at most one per keyframe
  std::uint64_t first_sequence = 0;       ///< KeyFrame::sequence of the keyframe that made it
  int visible = 1;                        ///< frames that should have seen it
  int found = 1;                          ///< frames that did
};

}  // namespace cpslam
