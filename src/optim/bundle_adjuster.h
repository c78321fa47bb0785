#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "geometry/se3.h"
#include "optim/observation.h"

namespace cpslam {

/// A snapshot of part of the map: indices instead of ids, nothing shared with the live map.
struct BundleProblem {
  struct Observation {
    int pose = 0;   ///< index into cam_from_world
    int point = 0;  ///< index into point_in_world
    PointObservation seen;
  };
  ReprojectionCamera camera;
  std::vector<SE3> cam_from_world;
  std::vector<std::uint8_t> pose_fixed;  ///< parallel to cam_from_world
  std::vector<Eigen::Vector3d> point_in_world;
  std::vector<Observation> observations;
};

struct BundleOptions {
  int robust_iterations = 5;  ///< first round, with the Huber kernel
  int final_iterations = 10;  ///< second round, without kernel and without the outliers of the first
  /// A round ends early when an iteration lowers the cost by less than this part of it.
  double function_tolerance = 1e-4;
  int threads = 1;
  const std::atomic<bool>* abort = nullptr;  ///< read after every iteration; true ends the solve early
};

struct BundleResult {
  bool aborted = false;  ///< poses and points are still the best found so far
  std::vector<std::uint8_t>
      outlier;                ///< parallel to the observations: beyond the 95 % gate or behind the camera
  double initial_cost = 0.0;  ///< half the Huber sum of all finite observations before the call
  double final_cost = 0.0;    ///< the same sum at the result
  int iterations = 0;         ///< of both rounds, rejected steps included
};

/// Bundle adjustment by Ceres (Schur complement, analytic Jacobians; Triggs et al. 2000) that refines
/// problem.cam_from_world and problem.point_in_world in place. Fixed poses and points without a usable
/// observation keep their values bit by bit. Observations of non-finite points or pixels are outliers and
/// take no part. At least one pose must be fixed; throws InputError otherwise, when an index is out of range
/// or when the lists' sizes disagree. Without observations nothing happens. Deterministic with one thread.
BundleResult adjust_bundle(BundleProblem& problem, const BundleOptions& options);

}  // namespace cpslam
