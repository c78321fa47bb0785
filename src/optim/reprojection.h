#pragma once

#include <Eigen/Core>
#include <cmath>

#include "optim/observation.h"

namespace cpslam {

/// A point nearer to the camera plane than this, or behind it, is not visible (m).
inline constexpr double kMinDepthM = 0.01;

/// 1 / z and minus its derivative. Below kMinDepthM the tangent goes on, so that the residuals stay finite,
/// have a continuous gradient, and push a point that a trial step threw behind the camera back to the front.
/// Scalar: double, or several of them in a vector of the compiler.
template <typename Scalar>
struct InverseDepth {
  Scalar value;
  Scalar minus_slope;
};
template <typename Scalar>
[[nodiscard]] inline InverseDepth<Scalar> inverse_depth(const Scalar& z) {
  constexpr double kLimit = 1.0 / kMinDepthM;
  const Scalar inverse = 1.0 / z;
  const Scalar tangent = kLimit * (2.0 - kLimit * z);
  const Scalar tangent_slope = Scalar{} + kLimit * kLimit;
  const auto visible = z > kMinDepthM;
  return {visible ? inverse : tangent, visible ? inverse * inverse : tangent_slope};
}

/// Whitened residuals [u, v, disparity] of one observation (no unit); the third is 0 without depth.
[[nodiscard]] inline Eigen::Vector3d reprojection_error(const ReprojectionCamera& camera,
                                                        const Eigen::Vector3d& point_in_cam,
                                                        const PointObservation& seen) {
  const double inverse = inverse_depth(point_in_cam.z()).value;
  Eigen::Vector3d error;
  error.x() = (seen.uv.x() - camera.cx - camera.fx * point_in_cam.x() * inverse) / seen.sigma_px;
  error.y() = (seen.uv.y() - camera.cy - camera.fy * point_in_cam.y() * inverse) / seen.sigma_px;
  error.z() = seen.has_depth() ? (seen.disparity - camera.bf * inverse) / seen.sigma_disparity_px : 0.0;
  return error;
}

/// Derivative of reprojection_error by the point in the camera's frame; the third row is 0 without depth.
[[nodiscard]] inline Eigen::Matrix3d reprojection_jacobian(const ReprojectionCamera& camera,
                                                           const Eigen::Vector3d& point_in_cam,
                                                           const PointObservation& seen) {
  const auto [inverse, minus_slope] = inverse_depth(point_in_cam.z());
  const double gain_u = -camera.fx / seen.sigma_px;
  const double gain_v = -camera.fy / seen.sigma_px;
  const double gain_depth = seen.has_depth() ? camera.bf / seen.sigma_disparity_px : 0.0;
  Eigen::Matrix3d jacobian;
  jacobian << gain_u * inverse, 0.0, -gain_u * point_in_cam.x() * minus_slope,  //
      0.0, gain_v * inverse, -gain_v * point_in_cam.y() * minus_slope,          //
      0.0, 0.0, gain_depth * minus_slope;
  return jacobian;
}

/// The 95 % gate of the squared whitened residual. Its root is also the width of the Huber kernel.
[[nodiscard]] inline double chi2_gate(const PointObservation& seen) {
  return seen.has_depth() ? kChi2Depth : kChi2Mono;
}

/// Huber's kernel on a squared residual: quadratic up to the gate, then linear in the residual.
[[nodiscard]] inline double huber(double chi2, double gate) {
  return chi2 <= gate ? chi2 : 2.0 * std::sqrt(chi2 * gate) - gate;
}

}  // namespace cpslam
