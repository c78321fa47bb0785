#include "slam/pose_refinement.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "optim/pose_solver.h"
#include "slam/observation_model.h"

namespace cpslam {
namespace {

constexpr double kMaxSigmaM = 0.03;
constexpr double kMaxSigmaRad = 0.015;

double largest_sigma(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues().z());
}

}  // namespace

bool is_well_determined(const Eigen::Matrix<double, 6, 6>& covariance) {
  return largest_sigma(covariance.topLeftCorner<3, 3>()) < kMaxSigmaM &&
         largest_sigma(covariance.bottomRightCorner<3, 3>()) < kMaxSigmaRad;
}

RefinedPose refine_pose(const Rig& rig, Frame& frame) {
  std::vector<PoseObservation> observations;
  std::vector<std::size_t> keypoints;
  for (std::size_t i = 0; i < frame.matches.size(); ++i) {
    if (frame.matches[i].kind == PointMatch::Kind::kNone) continue;
    observations.push_back(
        {frame.matches[i].position_in_world, observe(rig, *frame.features, static_cast<int>(i))});
    keypoints.push_back(i);
  }
  const PoseSolverResult solved = solve_pose(rig.reprojection, frame.cam_from_world, observations);
  frame.cam_from_world = solved.cam_from_world;
  RefinedPose refined;
  refined.covariance = solved.covariance;
  for (std::size_t k = 0; k < keypoints.size(); ++k) {
    PointMatch& match = frame.matches[keypoints[k]];
    if (solved.outlier[k] != 0) {
      match = {};
    } else if (match.kind == PointMatch::Kind::kMapPoint) {
      ++refined.map_points;
    } else {
      ++refined.temporary_points;
    }
  }
  return refined;
}

}  // namespace cpslam
