#pragma once

#include <Eigen/Core>

namespace cpslam {

/// One measured keypoint: undistorted pixel and, where the keypoint has depth, the disparity bf / depth
/// it would have in the virtual right camera (Mur-Artal and Tardos 2017). Kept apart from u: the two sensors
/// err independently.
struct PointObservation {
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();  ///< px
  double disparity = 0.0;                        ///< px; 0: no depth, a monocular observation
  double sigma_px = 1.0;                         ///< standard deviation of u and v
  double sigma_disparity_px = 1.0;               ///< standard deviation of the disparity, given depth

  [[nodiscard]] bool has_depth() const { return disparity > 0.0; }
};

/// Intrinsics of the residuals: e = [u - u_hat, v - v_hat, disparity - bf / z_hat].
struct ReprojectionCamera {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0, bf = 0.0;
};

/// Chi-square 95 % quantiles for 2 (monocular) and 3 (with depth) degrees of freedom.
inline constexpr double kChi2Mono = 5.991;
inline constexpr double kChi2Depth = 7.815;

}  // namespace cpslam
