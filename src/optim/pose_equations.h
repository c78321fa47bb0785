#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/se3.h"
#include "optim/pose_solver.h"

namespace cpslam {

/// Gauss-Newton model of the weighted chi-square around a pose: cost + 2 gradient.d + d.information.d for the
/// left perturbation d = (translation, rotation).
struct PoseModel {
  Eigen::Matrix<double, 6, 6> information;
  Eigen::Matrix<double, 6, 1> gradient;
  double cost = 0.0;
};

/// The observations of one frame, laid out in pairs for SIMD.
/// Observations that are not finite (or have no sensible sigma) are never active.
class PoseEquations {
 public:
  PoseEquations(const ReprojectionCamera& camera, std::span<const PoseObservation> observations);

  /// Sum over the active observations, with Huber weights if robust.
  [[nodiscard]] PoseModel linearize(const SE3& cam_from_world, bool robust) const;

  enum class Gate {
    kNone,     ///< all in front of the camera
    kRelaxed,  ///< within the 95 % gate, widened by as much as the median says that the pose is still off
    kExact,    ///< within the 95 % gate
  };
  /// Makes exactly those observations active that lie in front of the camera and within the gate.
  struct Selection {
    int n_active = 0;
    double chi2 = 0.0;  ///< sum over the active ones
    bool changed = false;
  };
  Selection select(const SE3& cam_from_world, Gate gate);

  [[nodiscard]] bool active(std::size_t i) const { return pairs_[i / 2].active[i % 2] != 0.0; }

 private:
  /// Two numbers that are worked on at once (GCC and Clang vector extension): one register of every x86-64 or
  /// 64-bit ARM processor.
  using Two = double __attribute__((vector_size(16)));
  struct Sums;

  /// Two observations; the second of the last pair may be a dummy that is never active.
  struct Pair {
    Two x{}, y{}, z{};                   ///< in the world, m
    Two u{}, v{}, disparity{};           ///< px, u and v from the principal point
    Two per_sigma{}, per_sigma_depth{};  ///< 1 / px; the second is 0 without depth
    Two gate{};                          ///< chi-square
    Two active{};                        ///< 1 or 0
  };

  [[nodiscard]] std::vector<double> chi2_per_gate(const SE3& cam_from_world) const;
  void add(const Pair& pair, const SE3& cam_from_world, bool robust, Sums& sums) const;

  ReprojectionCamera camera_;
  std::vector<Pair> pairs_;
  std::vector<std::uint8_t> valid_;
};

}  // namespace cpslam
