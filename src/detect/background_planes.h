#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "util/random.h"

namespace cpslam {

/// A plane as a depth grid sees it: inverse depth is linear in the cell's coordinates, whatever the plane.
struct GridPlane {
  float per_column = 0.0F, per_row = 0.0F, constant = 0.0F;  ///< 1 / m

  [[nodiscard]] float inverse_depth(int x, int y) const {
    return per_column * static_cast<float>(x) + per_row * static_cast<float>(y) + constant;
  }
  /// Whether a reading lies on the plane, within the sensor's noise there.
  [[nodiscard]] bool contains(int x, int y, float depth_m) const;
};

/// The planes that dominate around a person's box, at most four: the floor he stands on, the wall behind
/// him, a table. What goes on inside the box is not his, also where he touches it without a step in depth.
/// Found by RANSAC in the cells next to the box, the most dominant first.
[[nodiscard]] std::vector<GridPlane> find_background_planes(const cv::Mat1f& depth_m,
                                                            const cv::Rect& box_cells, Random& random);

}  // namespace cpslam
