#pragma once

#include <optional>
#include <span>
#include <vector>

#include "features/frame_features.h"
#include "geometry/se3.h"
#include "slam/rig.h"
#include "util/random.h"

namespace cpslam {

/// A world point that may be what a keypoint shows.
struct PoseHypothesisMatch {
  int keypoint = -1;
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
};

struct RansacPose {
  SE3 cam_from_world;
  std::vector<std::size_t> inliers;  ///< indices into the matches
};

/// Camera pose from matches of which many may be wrong, with no start: RANSAC (Fischler and Bolles 1981) over
/// rigid alignments of three matches whose keypoints have depth; keypoints without depth take part in the
/// vote. Nothing when no pose has at least min_inliers.
[[nodiscard]] std::optional<RansacPose> ransac_pose(const Rig& rig, const FrameFeatures& features,
                                                    std::span<const PoseHypothesisMatch> matches,
                                                    std::size_t min_inliers, Random& random);

}  // namespace cpslam
