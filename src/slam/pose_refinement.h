#pragma once

#include "slam/frame.h"
#include "slam/rig.h"

namespace cpslam {

struct RefinedPose {
  int map_points = 0;        ///< inliers that are points of the map
  int temporary_points = 0;  ///< inliers that are not
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Optimises the frame's pose on its matches and removes the matches that disagree with it. With fewer than
/// three matches the pose stays and all matches go.
RefinedPose refine_pose(const Rig& rig, Frame& frame);

}  // namespace cpslam
