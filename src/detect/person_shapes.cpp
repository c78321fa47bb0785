#include "detect/person_shapes.h"

#include <algorithm>
#include <cstddef>

#include "geometry/world_point.h"

namespace cpslam {
namespace {

PersonShape shape_of(const GridCamera& camera, const PersonTrack& track,
                     const FloatTransform& world_from_camera) {
  PersonShape shape;
  shape.number = track.number;
  shape.hidden = track.visible.size() == 0;
  const GridSurface& surface = shape.hidden ? track.shape : track.visible;
  shape.surface.reserve(surface.size());
  double depth_sum_m = 0.0;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    depth_sum_m += surface.depth_m[i];
    shape.surface.push_back(
        to_world_point(world_from_camera * camera.point(surface.cells[i], surface.depth_m[i])));
  }
  const double mean_depth_m = depth_sum_m / static_cast<double>(std::max<std::size_t>(surface.size(), 1));
  shape.spacing_m = static_cast<float>(mean_depth_m * kDepthCellPx / camera.camera().fx());
  shape.velocity_m_per_s =
      to_world_point(Eigen::Vector3f(world_from_camera.rotation * track.velocity_m_per_s));
  return shape;
}

}  // namespace

std::vector<PersonShape> person_shapes(const GridCamera& camera, const std::vector<PersonTrack>& tracks,
                                       const SE3& world_from_camera) {
  const FloatTransform transform(world_from_camera);
  std::vector<PersonShape> shapes;
  shapes.reserve(tracks.size());
  for (const PersonTrack& track : tracks) shapes.push_back(shape_of(camera, track, transform));
  return shapes;
}

}  // namespace cpslam
