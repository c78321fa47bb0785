#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/se3.h"
#include "optim/observation.h"

namespace cpslam {

/// A known point of the map and where the frame saw it.
struct PoseObservation {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  PointObservation seen;
};

/// The last rounds of the solver run without the robust kernel.
inline constexpr int kRoundsWithoutKernel = 2;

/// Variance (m^2 or rad^2) that the solver reports for directions which the inliers do not determine.
inline constexpr double kUnknownPoseVariance = 1e6;

struct PoseSolverOptions {
  int rounds = 4;  ///< each re-decides all outliers, the robust ones with a gate that follows the median
  int iterations_per_round = 20;  ///< at most; a round ends when the step is negligible
};

struct PoseSolverResult {
  SE3 cam_from_world;
  std::vector<std::uint8_t> outlier;  ///< parallel to the observations; 1 = beyond the chi-square 95 % gate
  int n_inliers = 0;
  double chi2 = 0.0;  ///< sum over the inliers
  /// Of the left perturbation twist (translation, rotation) of cam_from_world; inverse of the inliers'
  /// information, kUnknownPoseVariance in the directions where that is singular. Always finite.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Pose-only optimisation: Levenberg-Marquardt on SE(3) with a Huber kernel and outlier rounds (motion-only
/// bundle adjustment of Mur-Artal and Tardos 2017, section III-B). Observations behind the camera, with
/// numbers that are not finite or without a positive sigma are outliers. Fewer than three usable
/// observations: the start pose comes back with every observation an outlier. The pose is always finite if
/// the start is; whether the inliers determine it is for the covariance to say. Pure function, deterministic.
[[nodiscard]] PoseSolverResult solve_pose(const ReprojectionCamera& camera, const SE3& start_cam_from_world,
                                          std::span<const PoseObservation> observations,
                                          const PoseSolverOptions& options = {});

}  // namespace cpslam
