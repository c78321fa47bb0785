#include "optim/bundle_adjuster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "ceres/loss_function.h"
#include "ceres/ordered_groups.h"
#include "cpslam/error.h"
#include "optim/ceres_run.h"
#include "optim/reprojection.h"
#include "optim/reprojection_cost.h"

namespace cpslam {
namespace {

// Up to here the reduced camera system is dense enough for a dense factorisation to be the quicker one.
constexpr int kMaxDensePoses = 50;

void check(const BundleProblem& problem) {
  const std::size_t n_poses = problem.cam_from_world.size();
  if (problem.pose_fixed.size() != n_poses) {
    throw InputError("adjust_bundle: pose_fixed has " + std::to_string(problem.pose_fixed.size()) +
                     " entries for " + std::to_string(n_poses) + " poses");
  }
  for (const BundleProblem::Observation& observation : problem.observations) {
    if (observation.pose < 0 || static_cast<std::size_t>(observation.pose) >= n_poses) {
      throw InputError("adjust_bundle: an observation names pose " + std::to_string(observation.pose) +
                       " of " + std::to_string(n_poses));
    }
    if (observation.point < 0 ||
        static_cast<std::size_t>(observation.point) >= problem.point_in_world.size()) {
      throw InputError("adjust_bundle: an observation names point " + std::to_string(observation.point) +
                       " of " + std::to_string(problem.point_in_world.size()));
    }
  }
  const bool anchored = std::any_of(problem.pose_fixed.begin(), problem.pose_fixed.end(),
                                    [](std::uint8_t fixed) { return fixed != 0; });
  if (n_poses > 0 && !anchored) {
    throw InputError("adjust_bundle: no pose is fixed, so the map could drift freely; fix at least one");
  }
}

struct Judgement {
  std::vector<std::uint8_t> unusable;  ///< behind the camera or not finite
  std::vector<std::uint8_t> outlier;   ///< unusable or beyond the gate
  double cost = 0.0;
};

Judgement judge(const BundleProblem& problem) {
  const std::size_t n = problem.observations.size();
  Judgement result{std::vector<std::uint8_t>(n, 1), std::vector<std::uint8_t>(n, 1), 0.0};
  for (std::size_t i = 0; i < n; ++i) {
    const auto& [pose, point, seen] = problem.observations[i];
    const Eigen::Vector3d point_in_cam = problem.cam_from_world[static_cast<std::size_t>(pose)] *
                                         problem.point_in_world[static_cast<std::size_t>(point)];
    const double chi2 = reprojection_error(problem.camera, point_in_cam, seen).squaredNorm();
    if (!std::isfinite(chi2)) continue;
    result.cost += 0.5 * huber(chi2, chi2_gate(seen));
    if (point_in_cam.z() <= kMinDepthM) continue;
    result.unusable[i] = 0;
    result.outlier[i] = chi2 > chi2_gate(seen) ? 1 : 0;
  }
  return result;
}

/// One Ceres problem over the parameters of a BundleProblem; its blocks live here until write_back().
class BundleRound {
 public:
  BundleRound(BundleProblem& bundle, const std::vector<std::uint8_t>& left_out, bool robust)
      : bundle_(bundle), poses_(bundle.cam_from_world.size()), ceres_problem_(problem_options()) {
    pose_used_.resize(poses_.size());
    std::vector<std::uint8_t> point_used(bundle.point_in_world.size());
    for (std::size_t i = 0; i < bundle.observations.size(); ++i) {
      if (left_out[i] == 0) add(bundle.observations[i], robust, point_used);
    }
    for (std::size_t i = 0; i < point_used.size(); ++i) {
      if (point_used[i] != 0) ordering_->AddElementToGroup(bundle.point_in_world[i].data(), 0);
    }
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (pose_used_[i] == 0) continue;
      ordering_->AddElementToGroup(poses_[i].data(), 1);
      if (bundle.pose_fixed[i] != 0) {
        ceres_problem_.SetParameterBlockConstant(poses_[i].data());
      } else {
        ceres_problem_.SetManifold(poses_[i].data(), &manifold_);
        ++n_free_poses_;
      }
    }
  }

  /// Iterations done.
  int solve(const BundleOptions& options, int max_iterations) {
    if (ceres_problem_.NumResidualBlocks() == 0 || max_iterations <= 0) return 0;
    ceres::Solver::Options solver;
    // Without a free pose there is no Schur complement; Ceres then turns the sparse kind, and only that one,
    // into a solver that knows the points to be independent.
    solver.linear_solver_type =
        n_free_poses_ > 0 && n_free_poses_ <= kMaxDensePoses ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
    solver.linear_solver_ordering = ordering_;
    solver.max_num_iterations = max_iterations;
    solver.function_tolerance = options.function_tolerance;
    solver.num_threads = options.threads;
    const ceres::Solver::Summary summary = run_ceres(std::move(solver), options.abort, ceres_problem_);
    write_back();
    return iterations_of(summary);
  }

 private:
  using PoseBlock = std::array<double, PoseManifold::kAmbient>;

  static ceres::Problem::Options problem_options() {
    ceres::Problem::Options options = borrowing_problem_options();
    options.disable_all_safety_checks = true;  // every block is added once, from arrays of our own
    return options;
  }

  void add(const BundleProblem::Observation& observation, bool robust,
           std::vector<std::uint8_t>& point_used) {
    const auto pose = static_cast<std::size_t>(observation.pose);
    const auto point = static_cast<std::size_t>(observation.point);
    if (pose_used_[pose] == 0) write_pose_block(bundle_.cam_from_world[pose], poses_[pose].data());
    pose_used_[pose] = 1;
    point_used[point] = 1;
    double* const pose_block = poses_[pose].data();
    double* const point_block = bundle_.point_in_world[point].data();
    if (observation.seen.has_depth()) {
      ceres_problem_.AddResidualBlock(&depth_costs_.emplace_back(bundle_.camera, observation.seen),
                                      robust ? &depth_loss_ : nullptr, pose_block, point_block);
    } else {
      ceres_problem_.AddResidualBlock(&mono_costs_.emplace_back(bundle_.camera, observation.seen),
                                      robust ? &mono_loss_ : nullptr, pose_block, point_block);
    }
  }

  void write_back() {
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (pose_used_[i] != 0 && bundle_.pose_fixed[i] == 0) {
        bundle_.cam_from_world[i] = read_pose_block(poses_[i].data());
      }
    }
  }

  BundleProblem& bundle_;
  std::vector<PoseBlock> poses_;
  std::vector<std::uint8_t> pose_used_;
  int n_free_poses_ = 0;
  PoseManifold manifold_;
  ceres::HuberLoss mono_loss_{std::sqrt(kChi2Mono)};
  ceres::HuberLoss depth_loss_{std::sqrt(kChi2Depth)};
  std::deque<MonoCost> mono_costs_;
  std::deque<DepthCost> depth_costs_;
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_ =
      std::make_shared<ceres::ParameterBlockOrdering>();
  ceres::Problem ceres_problem_;  // last: refers to all above
};

}  // namespace

BundleResult adjust_bundle(BundleProblem& problem, const BundleOptions& options) {
  check(problem);
  BundleResult result;
  Judgement judgement = judge(problem);
  result.initial_cost = judgement.cost;
  if (!is_raised(options.abort)) {
    result.iterations +=
        BundleRound(problem, judgement.unusable, true).solve(options, options.robust_iterations);
    judgement = judge(problem);
  }
  if (!is_raised(options.abort)) {
    result.iterations +=
        BundleRound(problem, judgement.outlier, false).solve(options, options.final_iterations);
    judgement = judge(problem);
  }
  // The flag may also have come up after the last iteration; nothing was cut short then, but saying so is
  // harmless.
  result.aborted = is_raised(options.abort);
  result.outlier = std::move(judgement.outlier);
  result.final_cost = judgement.cost;
  return result;
}

}  // namespace cpslam
