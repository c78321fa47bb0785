#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "cpslam/types.h"
#include "detect/grid_camera.h"
#include "detect/scene_evidence.h"
#include "detect/sdf_model.h"
#include "util/random.h"

namespace cpslam {

/// A keypoint as the people filter sees it: px of the image as taken, depth 0 where there is none.
struct DepthKeypoint {
  float x = 0.0F;
  float y = 0.0F;
  float depth_m = 0.0F;
};

/// Whether a keypoint lies in a box.
[[nodiscard]] inline bool contains(const PersonBox& box, const DepthKeypoint& k) {
  const auto x = static_cast<double>(k.x);
  const auto y = static_cast<double>(k.y);
  return x >= box.x && y >= box.y && x < box.x + box.width && y < box.y + box.height;
}

/// The surface of the person in a box.
struct PersonFit {
  SdfModel model;          ///< invalid: the box holds no depth
  std::vector<int> cells;  ///< of the depth grid, ascending
  std::vector<int> front;  ///< GrownSurface::front
  float match = 0.0F;      ///< how well the surface ends where the box ends, 0 to 1
};

/// Finds the person in every box: fit_sdf_model on the depths of keypoints and of grid cells inside the box,
/// growth of its inliers over depth-connected cells, and of the surfaces found that way the one that ends
/// where the box ends. Where boxes claim the same surface, the one whose outline it is gets it; what it
/// covers takes no part in the next one's fit. The results are parallel to the boxes. Depths of people
/// carried into the frame count for more, those of surfaces that have stood still for less.
[[nodiscard]] std::vector<PersonFit> fit_people(const GridCamera& camera, const SceneEvidence& scene,
                                                std::span<const KnownBox> boxes,
                                                std::span<const DepthKeypoint> keypoints, Random& random);

/// How well a surface ends where a box ends: the overlap of the box with the one around the cells
/// (ascending).
[[nodiscard]] float outline_match(const std::vector<int>& cells, int columns, const cv::Rect& box_cells);

/// Cells of the grid that a box covers, at least one; empty when it lies outside the image, or is no box: a
/// size not above zero, a number not finite.
[[nodiscard]] cv::Rect cells_of_box(const GridCamera& camera, const PersonBox& box);

}  // namespace cpslam
