#include "optim/pose_graph.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numeric>
#include <string>
#include <utility>

#include "ceres/loss_function.h"
#include "cpslam/error.h"
#include "optim/ceres_run.h"
#include "optim/relative_pose_cost.h"

namespace cpslam {
namespace {

constexpr double kChi2Pose = 12.592;  // 95 % quantile for six degrees of freedom

bool is_finite(const SE3& pose) {
  return pose.rotation.allFinite() && pose.translation.allFinite();
}

[[noreturn]] void refuse(std::size_t edge, const std::string& why) {
  throw InputError("optimize_pose_graph: edge " + std::to_string(edge) + " " + why);
}

void check(const PoseGraph& graph) {
  const std::size_t n_poses = graph.cam_from_world.size();
  if (graph.pose_fixed.size() != n_poses) {
    throw InputError("optimize_pose_graph: pose_fixed has " + std::to_string(graph.pose_fixed.size()) +
                     " entries for " + std::to_string(n_poses) + " poses");
  }
  const auto exists = [n_poses](int i) { return i >= 0 && static_cast<std::size_t>(i) < n_poses; };
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const PoseGraph::Edge& edge = graph.edges[e];
    if (!exists(edge.a) || !exists(edge.b)) {
      refuse(e, "joins poses " + std::to_string(edge.a) + " and " + std::to_string(edge.b) + " of " +
                    std::to_string(n_poses));
    }
    if (edge.a == edge.b) refuse(e, "joins pose " + std::to_string(edge.a) + " to itself");
    if (!is_finite(edge.b_from_a) || !edge.information.allFinite()) refuse(e, "is not finite");
    for (const int i : {edge.a, edge.b}) {
      if (!is_finite(graph.cam_from_world[static_cast<std::size_t>(i)])) {
        refuse(e, "joins pose " + std::to_string(i) + ", which is not finite");
      }
    }
  }
}

Eigen::Matrix<double, 6, 6> root_of(const PoseGraph& graph, std::size_t edge) {
  const Eigen::LLT<Eigen::Matrix<double, 6, 6>> cholesky(graph.edges[edge].information);
  if (cholesky.info() != Eigen::Success) refuse(edge, "has an information that is not positive definite");
  return cholesky.matrixU();
}

/// For each pose whether it has to stay: the fixed ones, and the first of every connected part that has none.
std::vector<std::uint8_t> held_poses(const PoseGraph& graph) {
  std::vector<std::size_t> root(graph.cam_from_world.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&root](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const PoseGraph::Edge& edge : graph.edges) {
    const auto [first, second] =
        std::minmax({find(static_cast<std::size_t>(edge.a)), find(static_cast<std::size_t>(edge.b))});
    root[second] = first;
  }
  std::vector<std::uint8_t> part_is_held(root.size());
  for (std::size_t i = 0; i < root.size(); ++i) {
    if (graph.pose_fixed[i] != 0) part_is_held[find(i)] = 1;
  }
  std::vector<std::uint8_t> held = graph.pose_fixed;
  for (std::size_t i = 0; i < root.size(); ++i) {
    if (find(i) == i && part_is_held[i] == 0) held[i] = 1;  // the root of a part is its first pose
  }
  return held;
}

/// The Ceres problem of a graph; its blocks live here.
class Solve {
 public:
  Solve(const PoseGraph& graph, bool robust)
      : poses_(graph.cam_from_world.size()),
        used_(poses_.size()),
        ceres_problem_(borrowing_problem_options()) {
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
      const PoseGraph::Edge& edge = graph.edges[e];
      ceres_problem_.AddResidualBlock(&costs_.emplace_back(edge.b_from_a, root_of(graph, e)),
                                      robust ? &loss_ : nullptr, block(graph, edge.a), block(graph, edge.b));
    }
    const std::vector<std::uint8_t> held = held_poses(graph);
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (used_[i] == 0) continue;
      if (held[i] != 0) {
        ceres_problem_.SetParameterBlockConstant(poses_[i].data());
        used_[i] = 0;
      } else {
        ceres_problem_.SetManifold(poses_[i].data(), &manifold_);
      }
    }
  }

  ceres::Solver::Summary run(const PoseGraphOptions& options) {
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    solver.max_num_iterations = options.iterations;
    solver.function_tolerance = options.function_tolerance;
    solver.num_threads = options.threads;
    return run_ceres(std::move(solver), options.abort, ceres_problem_);
  }

  void write_back(PoseGraph& graph) const {
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (used_[i] != 0) graph.cam_from_world[i] = read_pose_block(poses_[i].data());
    }
  }

 private:
  double* block(const PoseGraph& graph, int index) {
    const auto i = static_cast<std::size_t>(index);
    if (used_[i] == 0) write_pose_block(graph.cam_from_world[i], poses_[i].data());
    used_[i] = 1;
    return poses_[i].data();
  }

  std::vector<std::array<double, PoseManifold::kAmbient>> poses_;
  std::vector<std::uint8_t> used_;  // afterwards: and free
  PoseManifold manifold_;
  ceres::HuberLoss loss_{std::sqrt(kChi2Pose)};
  std::deque<RelativePoseCost> costs_;
  ceres::Problem ceres_problem_;  // last: refers to all above
};

}  // namespace

PoseGraphResult optimize_pose_graph(PoseGraph& graph, const PoseGraphOptions& options) {
  check(graph);
  PoseGraphResult result;
  Solve solve(graph, options.robust);
  if (graph.edges.empty()) return result;
  const ceres::Solver::Summary summary = solve.run(options);
  result.aborted = is_raised(options.abort);
  result.initial_cost = summary.initial_cost;
  result.final_cost = summary.final_cost;
  result.iterations = iterations_of(summary);
  // Poses go through a quaternion on their way; one that did not move comes back as it was.
  if (summary.final_cost < summary.initial_cost) solve.write_back(graph);
  return result;
}

}  // namespace cpslam
