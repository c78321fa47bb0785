#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/se3.h"
#include "optim/pose_solver.h"

namespace cpslam {

/// Gauss-Newton model of the weighted chi-square around a pose: cost + 2 gradient.d + d.information.d for the left
/// perturbation d = (translation, rotation).
struct PoseModel {
  Eigen::Matrix<double, 6, 6> information;
  Eigen::Matrix<double, 6, 1> gradient;
  double cost = 0.0;
};

/// The observations of one frame, one array per number, so that the compiler vectorises the sums over them.
/// Observations that are not finite (or have no sensible sigma) are never active.
class PoseEquations {
 public:
  PoseEquations(const ReprojectionCamera& camera, std::span<const PoseObservation> observations);

  /// Sum over the active observations, with Huber weights if robust.
  [[nodiscard]] PoseModel linearize(const SE3& cam_from_world, bool robust) const;

  /// Makes exactly those observations active that lie in front of the camera and, if gated, within the 95 % gate.
  struct Selection {
    int n_active = 0;
    double chi2 = 0.0;  ///< sum over the active ones
    bool changed = false;
  };
  Selection select(const SE3& cam_from_world, bool gated);

  [[nodiscard]] bool active(std::size_t i) const { return active_[i] != 0.0; }

 private:
  ReprojectionCamera camera_;
  std::size_t n_ = 0;  ///< without the padding to whole groups of lanes
  std::vector<double> x_, y_, z_;                    ///< in the world, m
  std::vector<double> u_, v_, disparity_;            ///< px, u and v from the principal point
  std::vector<double> per_sigma_, per_sigma_depth_;  ///< 1 / px; the second is 0 without depth
  std::vector<double> gate_;                         ///< chi-square
  std::vector<double> active_;                       ///< 1 or 0
  std::vector<std::uint8_t> valid_;
};

}  // namespace cpslam
