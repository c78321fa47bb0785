#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "geometry/se3.h"

namespace cpslam {

/// Poses and what is known of them in pairs; indices instead of ids, nothing shared with the live map.
struct PoseGraph {
  struct Edge {
    int a = 0;  ///< indices into cam_from_world
    int b = 0;
    SE3 b_from_a;  ///< as measured
    /// Of the twist log(estimated * measured^-1), translation (m) before rotation (rad), in b's frame.
    Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Identity();
  };
  std::vector<SE3> cam_from_world;
  std::vector<std::uint8_t> pose_fixed;  ///< parallel to cam_from_world
  std::vector<Edge> edges;
};

struct PoseGraphOptions {
  int iterations = 50;
  /// The solve ends early when an iteration lowers the cost by less than this part of it.
  double function_tolerance = 1e-6;
  bool robust = false;  ///< Huber kernel at the chi-square 95 % quantile of six degrees of freedom
  int threads = 1;
  const std::atomic<bool>* abort = nullptr;  ///< read after every iteration; true ends the solve early
};

struct PoseGraphResult {
  bool aborted = false;       ///< the poses are still the best found so far
  double initial_cost = 0.0;  ///< half the sum of the squared whitened errors, through the kernel if robust
  double final_cost = 0.0;
  int iterations = 0;  ///< rejected steps included
};

/// Optimises graph.cam_from_world in place (Ceres, sparse Cholesky, analytic Jacobians; Lu and Milios 1997).
/// No scale: depth makes it observable. Fixed poses and poses without an edge keep their values bit by bit,
/// as does a graph without error. In each connected part without a fixed pose the first pose holds the gauge.
/// Throws InputError when the lists' sizes disagree, an index is out of range or joins a pose to itself, a
/// number is not finite or an information matrix is not positive definite. Deterministic with one thread.
PoseGraphResult optimize_pose_graph(PoseGraph& graph, const PoseGraphOptions& options);

}  // namespace cpslam
