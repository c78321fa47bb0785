#include "detect/camera_motion.h"

#include <algorithm>
#include <vector>

#include "camera/depth_noise.h"
#include "optim/pose_solver.h"

namespace cpslam {
namespace {

constexpr double kBaselineM = 0.08;           // of the virtual stereo pair that carries the depths
constexpr double kKeypointSigmaPx = 1.5;      // over all pyramid levels
constexpr double kMinDisparitySigmaPx = 3.0;  // corners lie on rims
constexpr int kMinInliers = 30;
constexpr double kMinInlierShare = 0.5;
constexpr std::size_t kMostKeypoints = 400;

ReprojectionCamera reprojection_of(const PinholeCamera& camera) {
  return {camera.fx(), camera.fy(), camera.cx(), camera.cy(), camera.fx() * kBaselineM};
}

PointObservation observe(const PinholeCamera& camera, double bf, const DepthKeypoint& k) {
  const Eigen::Vector2d px(static_cast<double>(k.x), static_cast<double>(k.y));
  const auto depth_m = static_cast<double>(k.depth_m);
  PointObservation seen;
  seen.uv = camera.has_distortion() ? camera.undistort(px) : px;
  seen.disparity = bf / depth_m;
  seen.sigma_px = kKeypointSigmaPx;
  seen.sigma_disparity_px =
      std::max(kMinDisparitySigmaPx, seen.disparity / depth_m * structured_light_sigma_m(depth_m));
  return seen;
}

}  // namespace

std::optional<SE3> measure_camera_motion(const GridCamera& camera, const FlowKeypoints& previous,
                                         const cv::Mat1b& previous_people, const FlowKeypoints& current,
                                         const SE3& expected_this_from_previous) {
  const ReprojectionCamera reprojection = reprojection_of(camera.camera());
  const KeypointFlow flow(camera.camera(), current);
  const FloatTransform move(expected_this_from_previous);
  std::vector<PoseObservation> observations;
  const std::size_t stride = previous.keypoints.size() / kMostKeypoints + 1;
  for (std::size_t i = 0; i < previous.keypoints.size(); i += stride) {
    const DepthKeypoint& k = previous.keypoints[i];
    const int cell = k.depth_m > 0.0F ? camera.cell_of_pixel(k.x, k.y) : -1;
    if (cell < 0 || previous_people(cell) != 0) continue;
    const Eigen::Vector3f point = lift(camera.camera(), k);
    const int match = flow.find(move * point, previous.descriptors[i]);
    if (match < 0) continue;
    observations.push_back(
        {point.cast<double>(),
         observe(camera.camera(), reprojection.bf, current.keypoints[static_cast<std::size_t>(match)])});
  }
  const PoseSolverResult solved = solve_pose(reprojection, expected_this_from_previous, observations);
  if (solved.n_inliers < kMinInliers ||
      solved.n_inliers < kMinInlierShare * static_cast<double>(observations.size())) {
    return std::nullopt;
  }
  return solved.cam_from_world;
}

}  // namespace cpslam
