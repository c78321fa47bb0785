#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "cpslam/settings.h"
#include "cpslam/snapshot.h"
#include "geometry/se3.h"
#include "viewer/colours.h"
#include "viewer/framing.h"

namespace cpslam::viewer {

/// As they lie in the graphics card's memory.
struct Vertex {
  WorldPoint position;
  Colour colour;
};
struct Segment {
  Vertex from, to;
};
static_assert(sizeof(Vertex) == 16 && sizeof(Segment) == 32);

/// Every n-th point, so that there are no more than `most` of them (> 0).
[[nodiscard]] std::vector<WorldPoint> thinned(const std::vector<WorldPoint>& points, std::size_t most);

/// The map's points, coloured by their height along `up`.
[[nodiscard]] std::vector<Vertex> height_coloured(const std::vector<WorldPoint>& points,
                                                  const Eigen::Vector3d& up);
[[nodiscard]] std::vector<Vertex> coloured(const std::vector<WorldPoint>& points, Colour colour);

/// A square net of lines, a metre apart, on the floor below `extent`, fading outwards.
[[nodiscard]] std::vector<Segment> floor_grid(const Extent& extent, const Eigen::Vector3d& up, Colour colour);

/// The outline of what a camera sees down to depth_m.
[[nodiscard]] std::vector<Segment> frustum(const SE3& world_from_camera, const CameraSettings& camera,
                                           double depth_m, Colour colour);
[[nodiscard]] std::vector<Segment> frusta(const Trajectory& poses, const CameraSettings& camera,
                                          double depth_m, Colour colour);
/// Where somebody who is now at the middle of his surface will be soon.
[[nodiscard]] std::vector<Segment> motion_arrow(const PersonShape& person, const Eigen::Vector3d& up,
                                                Colour colour);
[[nodiscard]] std::vector<Segment> edge_lines(const std::vector<KeyFrameEdge>& edges,
                                              const Trajectory& keyframes, Colour colour);
/// Along the poses in steps of a centimetre or more, not across gaps of more than max_gap_s.
[[nodiscard]] std::vector<Segment> path(const Trajectory& trajectory, Colour colour, double max_gap_s = 1.0);

/// The part of a ground truth that was taken while the estimate was, in the estimate's world; empty while
/// there is too little of the estimate to align them.
[[nodiscard]] Trajectory aligned_truth(const Trajectory& truth, const Trajectory& estimate);

}  // namespace cpslam::viewer
