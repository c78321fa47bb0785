#include "slam/pose_ransac.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/alignment.h"
#include "slam/observation_model.h"

namespace cpslam {
namespace {

constexpr int kMaxIterations = 300;
constexpr double kConfidence = 0.999;
// Three noisy points make a rough pose: the vote is wider than the gate of the optimisation that follows.
constexpr double kGateWidening = 4.0;
// Degenerate samples (a line, a point) fix no rotation: twice the triangle's area must exceed this, m^2.
constexpr double kMinCross = 1e-3;

/// Draws needed to meet an all-inlier triple with kConfidence.
int iterations_needed(double inlier_ratio) {
  const double all_good = inlier_ratio * inlier_ratio * inlier_ratio;
  if (all_good >= 1.0) return 1;
  if (all_good <= 0.0) return kMaxIterations;
  const double needed = std::log(1.0 - kConfidence) / std::log(1.0 - all_good);
  return static_cast<int>(std::clamp(std::ceil(needed), 1.0, static_cast<double>(kMaxIterations)));
}

}  // namespace

std::optional<RansacPose> ransac_pose(const Rig& rig, const FrameFeatures& features,
                                      std::span<const PoseHypothesisMatch> matches, std::size_t min_inliers,
                                      Random& random) {
  std::vector<std::size_t> with_depth;
  std::vector<PointObservation> seen;
  seen.reserve(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    seen.push_back(observe(rig, features, matches[i].keypoint));
    if (seen.back().has_depth()) with_depth.push_back(i);
  }
  if (with_depth.size() < 3 || matches.size() < min_inliers) return std::nullopt;

  RansacPose best;
  int needed = kMaxIterations;
  for (int iteration = 0; iteration < needed; ++iteration) {
    std::array<Eigen::Vector3d, 3> in_world;
    std::array<Eigen::Vector3d, 3> in_camera;
    for (std::size_t k = 0; k < 3; ++k) {
      const PoseHypothesisMatch& match = matches[with_depth[random.index(with_depth.size())]];
      in_world[k] = match.position_in_world;
      in_camera[k] = back_project(rig, features, match.keypoint);
    }
    if ((in_world[1] - in_world[0]).cross(in_world[2] - in_world[0]).norm() < kMinCross) continue;
    const SE3 cam_from_world = align_points(in_world, in_camera);
    std::vector<std::size_t> inliers;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const double error = chi2(rig, seen[i], cam_from_world * matches[i].position_in_world);
      if (error < kGateWidening * chi2_gate(seen[i])) inliers.push_back(i);
    }
    if (inliers.size() <= best.inliers.size()) continue;
    best = {cam_from_world, std::move(inliers)};
    needed =
        iterations_needed(static_cast<double>(best.inliers.size()) / static_cast<double>(matches.size()));
  }
  if (best.inliers.size() < min_inliers) return std::nullopt;
  return best;
}

}  // namespace cpslam
