#pragma once

#include <atomic>

#include "ceres/problem.h"
#include "ceres/solver.h"

namespace cpslam {

[[nodiscard]] inline bool is_raised(const std::atomic<bool>* flag) {
  return flag != nullptr && flag->load(std::memory_order_relaxed);
}

/// A problem that owns neither cost functions nor kernels nor manifolds.
[[nodiscard]] ceres::Problem::Options borrowing_problem_options();

/// Solves silently. When the flag is raised the solve ends after the iteration under way, with the last
/// accepted step, the best so far. abort may be null.
ceres::Solver::Summary run_ceres(ceres::Solver::Options options, const std::atomic<bool>* abort,
                                 ceres::Problem& problem);

/// Iterations done, rejected steps included.
[[nodiscard]] int iterations_of(const ceres::Solver::Summary& summary);

}  // namespace cpslam
