#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "features/frame_features.h"
#include "features/scale_pyramid.h"

namespace cpslam {

/// Descriptor distances (of 256) below which two ORB descriptors may show the same point: the strict one
/// where only appearance speaks for a match, the loose one where a good prediction does (Mur-Artal et al.
/// 2015).
inline constexpr int kStrictDistance = 50;
inline constexpr int kLooseDistance = 100;

/// Where and how a point is expected in a frame.
struct ProjectionQuery {
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();  ///< undistorted px
  float disparity = 0.0F;  ///< expected bf / depth, px; checked against keypoints that have depth when > 0
  float radius = 0.0F;     ///< half side of the search window, px
  int min_octave = 0;
  int max_octave = 0;
  float angle_deg = 0.0F;  ///< of the keypoint it was seen as before; used by check_rotation only
  const Descriptor* descriptor = nullptr;
};

struct MatchOptions {
  int max_distance = kLooseDistance;
  float ratio = 1.0F;           ///< best / second best of the same octave must be below; 1 accepts all
  bool check_rotation = false;  ///< drop matches whose change of orientation disagrees with the majority
};

/// For every query the keypoint that looks most alike inside its window, or -1. A keypoint goes to one query,
/// the closest in appearance (the first of equals). Keypoints with taken[i] != 0 are left out; an empty span
/// takes none.
[[nodiscard]] std::vector<int> match_by_projection(const FrameFeatures& frame,
                                                   std::span<const ProjectionQuery> queries,
                                                   std::span<const std::uint8_t> taken,
                                                   const MatchOptions& options);

struct KeypointMatch {
  int a = -1;
  int b = -1;
};

/// One side of a match without prediction: the keypoints of a frame that take part.
struct KeypointSet {
  const FrameFeatures& features;
  std::span<const int> indices;
};

/// Mutually nearest pairs by appearance alone, every keypoint against every other: O(|a| |b|).
[[nodiscard]] std::vector<KeypointMatch> match_by_appearance(const KeypointSet& a, const KeypointSet& b,
                                                             const MatchOptions& options);

/// The matches whose change of orientation agrees with the majority's (see agrees_with_majority()).
[[nodiscard]] std::vector<KeypointMatch> keep_majority_rotation(const FrameFeatures& a,
                                                                const FrameFeatures& b,
                                                                const std::vector<KeypointMatch>& matches);

/// Geometry of a pair of views: x_b^T fundamental_ba x_a = 0 for undistorted homogeneous pixels.
struct EpipolarGeometry {
  Eigen::Matrix3d fundamental_ba = Eigen::Matrix3d::Zero();
  Eigen::Vector2d epipole_in_b = Eigen::Vector2d::Zero();  ///< px; the image of camera a's centre
};

/// Pairs that look alike and lie on each other's epipolar lines, for triangulation. Keypoints without depth
/// that are too near the epipole have no parallax and are left out.
[[nodiscard]] std::vector<KeypointMatch> match_by_epipolar_line(const KeypointSet& a, const KeypointSet& b,
                                                                const EpipolarGeometry& geometry,
                                                                const ScalePyramid& pyramid,
                                                                const MatchOptions& options);

}  // namespace cpslam
