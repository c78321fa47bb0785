#pragma once

#include <optional>

#include "map/map.h"
#include "match/orb_matcher.h"
#include "slam/rig.h"

namespace cpslam {

/// What matching needs of a map point, copied so that it can go on without the map's lock.
struct PointSnapshot {
  PointSnapshot(MapPointId point_id, const MapPoint& point)
      : id(point_id),
        position_in_world(point.position_in_world),
        normal(point.normal),
        descriptor(point.descriptor),
        min_distance_m(point.min_distance_m),
        max_distance_m(point.max_distance_m) {}

  MapPointId id;
  Eigen::Vector3d position_in_world;
  Eigen::Vector3d normal;
  Descriptor descriptor;
  float min_distance_m;
  float max_distance_m;
};

/// Half search windows at pyramid level 0, px: head on, and from another side than the point's usual one.
struct SearchWindow {
  float frontal_px = 0.0F;
  float oblique_px = 0.0F;
};

/// Where to look for the point in a camera at cam_from_world (centre_in_world is that camera's): nothing when
/// it lies outside the image, at a distance the pyramid cannot show, or is seen from more than 60 degrees off
/// its normal. The query refers to the snapshot's descriptor.
[[nodiscard]] std::optional<ProjectionQuery> expect_point(const Rig& rig, const PointSnapshot& point,
                                                          const SE3& cam_from_world,
                                                          const Eigen::Vector3d& centre_in_world,
                                                          SearchWindow window);

}  // namespace cpslam
