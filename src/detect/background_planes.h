#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "camera/depth_noise.h"
#include "util/random.h"

namespace cpslam {

/// A plane as a depth grid sees it: inverse depth is linear in the cell's coordinates, whatever the plane.
struct GridPlane {
  float per_column = 0.0F, per_row = 0.0F, constant = 0.0F;  ///< 1 / m

  [[nodiscard]] float inverse_depth(int x, int y) const {
    return per_column * static_cast<float>(x) + per_row * static_cast<float>(y) + constant;
  }
  /// Whether a reading lies on the plane, within the sensor's noise there.
  [[nodiscard]] bool contains(int x, int y, float depth_m) const {
    const float inverse = inverse_depth(x, y);
    return inverse > 0.0F && std::abs(depth_m - 1.0F / inverse) < tolerance_m(depth_m);
  }
  /// How far a reading on a plane may be from it (m).
  [[nodiscard]] static float tolerance_m(float depth_m) {
    return 0.015F + 3.0F * static_cast<float>(structured_light_sigma_m(static_cast<double>(depth_m)));
  }
};

/// The planes that dominate around a person's box, at most four: the floor he stands on, the wall behind
/// him, a table. What goes on inside the box is not his, also where he touches it without a step in depth.
/// Found by RANSAC in the cells next to the box, the most dominant first.
[[nodiscard]] std::vector<GridPlane> find_background_planes(const cv::Mat1f& depth_m,
                                                            const cv::Rect& box_cells, Random& random);

}  // namespace cpslam
