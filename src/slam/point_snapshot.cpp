#include "slam/point_snapshot.h"

#include "slam/observation_model.h"

namespace cpslam {

std::optional<ProjectionQuery> expect_point(const Rig& rig, const PointSnapshot& point,
                                            const SE3& cam_from_world, const Eigen::Vector3d& centre_in_world,
                                            SearchWindow window) {
  constexpr double kMinViewingCosine = 0.5;
  constexpr double kFrontalCosine = 0.998;
  const Eigen::Vector3d in_camera = cam_from_world * point.position_in_world;
  if (in_camera.z() <= 0.0) return std::nullopt;
  const Eigen::Vector2d uv = rig.camera.project(in_camera);
  if (!rig.camera.in_image(uv)) return std::nullopt;
  const Eigen::Vector3d ray = point.position_in_world - centre_in_world;
  const double distance_m = ray.norm();
  // A fifth beyond what the pyramid covers, for the rounding of levels.
  if (distance_m < 0.8 * point.min_distance_m || distance_m > 1.2 * point.max_distance_m) return std::nullopt;
  const double cosine = ray.dot(point.normal) / distance_m;
  if (cosine < kMinViewingCosine) return std::nullopt;
  const int octave = predict_octave(rig, distance_m, point.max_distance_m);
  ProjectionQuery query;
  query.uv = uv.cast<float>();
  query.disparity = static_cast<float>(rig.camera.bf() / in_camera.z());
  query.radius = (cosine > kFrontalCosine ? window.frontal_px : window.oblique_px) *
                 rig.pyramid.factor[static_cast<std::size_t>(octave)];
  query.min_octave = octave - 1;
  query.max_octave = octave + 1;
  query.descriptor = &point.descriptor;
  return query;
}

}  // namespace cpslam
