#include "slam/observation_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cpslam {
namespace {

// Localisation error of a FAST corner at its own pyramid level, px.
constexpr double kKeypointSigmaPx = 1.0;
// Disparity noise below this is not believed: registration of depth to colour and the shutter offset between the
// two sensors are not in the sensor's noise model.
constexpr double kMinDisparitySigmaPx = 0.5;

}  // namespace

PointObservation observe(const Rig& rig, const FrameFeatures& features, int keypoint) {
  const auto i = static_cast<std::size_t>(keypoint);
  const Keypoint& k = features.keypoints[i];
  PointObservation seen;
  seen.uv = {k.x, k.y};
  seen.sigma_px = kKeypointSigmaPx * rig.pyramid.factor[static_cast<std::size_t>(k.octave)];
  if (const double depth_m = features.depth_m[i]; depth_m > 0.0) {
    seen.disparity = rig.camera.bf() / depth_m;
    seen.sigma_disparity_px =
        std::max(kMinDisparitySigmaPx, seen.disparity / depth_m * static_cast<double>(features.depth_sigma_m[i]));
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
  const Eigen::Vector2d error = (seen.uv - rig.camera.project(point_in_camera)) / seen.sigma_px;
  double sum = error.squaredNorm();
  if (seen.has_depth()) {
    const double disparity_error = (seen.disparity - rig.camera.bf() / point_in_camera.z()) / seen.sigma_disparity_px;
    sum += disparity_error * disparity_error;
  }
  return sum;
}

int predict_octave(const Rig& rig, double distance_m, float max_distance_m) {
  const double ratio = static_cast<double>(max_distance_m) / distance_m;
  const int octave = static_cast<int>(std::lround(std::log(ratio) / rig.pyramid.log_factor));
  return std::clamp(octave, 0, rig.pyramid.n_levels() - 1);
}

}  // namespace cpslam
