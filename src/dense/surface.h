#pragma once

#include <Eigen/Core>
#include <vector>

#include "dense/dense_view.h"

namespace cpslam {

/// A piece of surface that a view shows, in the view's camera frame.
struct SurfacePoint {
  Eigen::Vector3f position_m;
  Eigen::Vector3f normal;  ///< unit, towards the camera
  float weight = 0.0F;     ///< inverse variance of its place, 1 for a reading at 1 m seen head-on
  int pixel = 0;           ///< of the view
};

/// One for each block no farther than max_depth_m whose surroundings are a surface, by the plane that fits
/// them best: on a plane the inverse depth is linear in the ray's direction, whatever the slope. Rims, where
/// readings hang between two surfaces, give none. Thread-safe.
[[nodiscard]] std::vector<SurfacePoint> surface_points(const DenseCamera& camera, const DenseView& view,
                                                       float max_depth_m);

}  // namespace cpslam
