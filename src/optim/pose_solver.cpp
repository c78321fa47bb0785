#include "optim/pose_solver.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "optim/pose_equations.h"

namespace cpslam {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

using Gate = PoseEquations::Gate;

constexpr int kMinObservations = 3;
/// A step that promises less than this in chi-square starts within 0.3 % of a standard deviation of the
/// optimum.
constexpr double kNegligibleChi2 = 1e-5;
/// The rounds with the kernel only prepare the others: 10 %.
constexpr double kNegligibleChi2Robust = 1e-2;
constexpr double kStartDamping = 1e-5;
constexpr double kMinDamping = 1e-9;
constexpr double kRejectedDamping = 1e-3;
constexpr double kMaxDamping = 1e8;
/// Least damping of a direction relative to the best known one: without it the pose runs away along
/// directions that the points hardly determine. Metres and radians are of one size at the distances of a
/// room.
constexpr double kDampingFloor = 0.01;
/// Relative to the largest eigenvalue; below it an eigenvalue is rounding noise of a singular matrix.
constexpr double kSingular = 1e-12;

/// Levenberg-Marquardt (Marquardt 1963) from the given pose, which only ever moves downhill. True: converged.
bool descend(const PoseEquations& equations, bool robust, int max_iterations, SE3& cam_from_world) {
  PoseModel model = equations.linearize(cam_from_world, robust);
  const double negligible = robust ? kNegligibleChi2Robust : kNegligibleChi2;
  double damping = kStartDamping;
  for (int iteration = 0; iteration < max_iterations && damping < kMaxDamping; ++iteration) {
    Matrix6d damped = model.information;
    const double floor = kDampingFloor * damped.diagonal().maxCoeff();
    damped.diagonal() += damping * model.information.diagonal().cwiseMax(floor);
    const Vector6d step = damped.ldlt().solve(-model.gradient);
    if (!step.allFinite()) return false;
    const double promised = -step.dot(2.0 * model.gradient + model.information * step);

    const SE3 trial = SE3::exp(step) * cam_from_world;
    const PoseModel trial_model = equations.linearize(trial, robust);
    if (trial_model.cost < model.cost) {
      cam_from_world = trial;
      model = trial_model;
      damping = std::max(0.1 * damping, kMinDamping);
    } else {
      damping = std::max(10.0 * damping, kRejectedDamping);
    }
    if (promised < negligible) return true;
  }
  return false;
}

Matrix6d covariance_of(const Matrix6d& information) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information);
  const double noise = kSingular * std::max(eigen.eigenvalues().maxCoeff(), 0.0);
  const Vector6d variances = eigen.eigenvalues().unaryExpr([noise](double value) {
    return value > noise ? std::min(1.0 / value, kUnknownPoseVariance) : kUnknownPoseVariance;
  });
  return eigen.eigenvectors() * variances.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

PoseSolverResult solve_pose(const ReprojectionCamera& camera, const SE3& start_cam_from_world,
                            std::span<const PoseObservation> observations, const PoseSolverOptions& options) {
  PoseSolverResult result;
  result.cam_from_world = start_cam_from_world;
  result.outlier.assign(observations.size(), 1);
  result.covariance = kUnknownPoseVariance * Matrix6d::Identity();

  PoseEquations equations(camera, observations);
  PoseEquations::Selection selection = equations.select(start_cam_from_world, Gate::kNone);
  if (selection.n_active < kMinObservations) return result;

  bool settled = false;  // the last round converged, with the kernel that the next one would have
  for (int round = 0; round < options.rounds && selection.n_active >= kMinObservations; ++round) {
    const bool robust = round < options.rounds - kRoundsWithoutKernel;
    if (round == options.rounds - kRoundsWithoutKernel) settled = false;
    if (settled && !selection.changed) continue;
    settled = descend(equations, robust, options.iterations_per_round, result.cam_from_world);
    selection = equations.select(result.cam_from_world, robust ? Gate::kRelaxed : Gate::kExact);
  }
  result.cam_from_world = result.cam_from_world.normalized();
  result.n_inliers = selection.n_active;
  result.chi2 = selection.chi2;
  for (std::size_t i = 0; i < observations.size(); ++i) result.outlier[i] = equations.active(i) ? 0 : 1;
  result.covariance = covariance_of(equations.linearize(result.cam_from_world, false).information);
  return result;
}

}  // namespace cpslam
