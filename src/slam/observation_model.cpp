#include "slam/observation_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cpslam {
namespace {

// Localisation error of a FAST corner at its own pyramid level, px.
constexpr double kKeypointSigmaPx = 1.0;
}  // namespace

PointObservation observe(const Rig& rig, const FrameFeatures& features, int keypoint,
                         double min_disparity_sigma_px) {
  const auto i = static_cast<std::size_t>(keypoint);
  const Keypoint& k = features.keypoints[i];
  PointObservation seen;
  seen.uv = {k.x, k.y};
  const double level_scale = rig.pyramid.factor[static_cast<std::size_t>(k.octave)];
  seen.sigma_px = kKeypointSigmaPx * level_scale;
  if (const double depth_m = features.depth_m[i]; depth_m > 0.0) {
    seen.disparity = features.disparity_px[i];
    const double sensor_sigma_px = seen.disparity / depth_m * static_cast<double>(features.depth_sigma_m[i]);
    seen.sigma_disparity_px = std::max(min_disparity_sigma_px * level_scale, sensor_sigma_px);
  }
  return seen;
}

Eigen::Vector3d back_project(const Rig& rig, const FrameFeatures& features, int keypoint) {
  const auto i = static_cast<std::size_t>(keypoint);
  const Keypoint& k = features.keypoints[i];
  return rig.camera.back_project({k.x, k.y}, features.depth_m[i]);
}

double chi2(const Rig& rig, const PointObservation& seen, const Eigen::Vector3d& point_in_camera) {
  if (point_in_camera.z() <= 0.0) return std::numeric_limits<double>::infinity();
  return reprojection_error(rig.reprojection, point_in_camera, seen).squaredNorm();
}

int predict_octave(const Rig& rig, double distance_m, float max_distance_m) {
  const double ratio = static_cast<double>(max_distance_m) / distance_m;
  const int octave = static_cast<int>(std::lround(std::log(ratio) / rig.pyramid.log_factor));
  return std::clamp(octave, 0, rig.pyramid.n_levels() - 1);
}

}  // namespace cpslam
