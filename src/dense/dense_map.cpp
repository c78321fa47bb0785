#include "cpslam/dense_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cpslam/error.h"
#include "dense/carving.h"
#include "dense/cloud_file.h"
#include "dense/dense_map_impl.h"
#include "dense/octomap_file.h"
#include "dense/surface.h"
#include "dense/thinning.h"
#include "dense/voxel_grid.h"

namespace cpslam {
namespace {

void check_range(const char* name, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return;
  throw InputError(std::string("dense map: ") + name + " " + std::to_string(value) + " is outside " +
                   std::to_string(lowest) + " to " + std::to_string(highest));
}

void add_view(const DenseCamera& camera, const PlacedView& placed, float max_depth_m, VoxelGrid& grid) {
  const Eigen::Matrix3f rotation = placed.world_from_view.rotation.cast<float>();
  for (const SurfacePoint& point : surface_points(camera, *placed.view, max_depth_m)) {
    grid.add(placed.world_from_view * point.position_m.cast<double>(), rotation * point.normal,
             placed.view->rgb[static_cast<std::size_t>(point.pixel)], point.weight);
  }
}

CloudPoint to_point(const Voxel& voxel) {
  CloudPoint point;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    point.position_m[k] = voxel.position_m[i];
    point.normal[k] = voxel.normal[i];
    point.rgb[k] = static_cast<std::uint8_t>(std::clamp(std::lround(voxel.rgb[i]), 0L, 255L));
  }
  return point;
}

}  // namespace

void DenseMapOptions::check() const {
  check_range("voxel_m", voxel_m, 0.005, 0.5);
  check_range("max_depth_m", max_depth_m, 0.3, 13.0);
}

DenseMap::Impl::Impl(const DenseMapOptions& options, std::shared_ptr<const DenseCamera> the_camera,
                     std::vector<PlacedView> the_views, std::size_t n_dropped)
    : camera(std::move(the_camera)), views(std::move(the_views)), n_dropped_views(n_dropped) {
  options.check();
  VoxelGrid grid(options.voxel_m);
  for (const PlacedView& view : views) add_view(*camera, view, static_cast<float>(options.max_depth_m), grid);
  std::vector<Voxel> voxels = grid.voxels();
  const std::size_t n_voxels = voxels.size();
  voxels = carve(std::move(voxels), static_cast<float>(options.voxel_m), *camera, views);
  n_carved_voxels = n_voxels - voxels.size();
  for (const Voxel& voxel : thin(voxels)) points.push_back(to_point(voxel));
}

DenseMap::DenseMap(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
DenseMap::~DenseMap() = default;
DenseMap::DenseMap(DenseMap&&) noexcept = default;
DenseMap& DenseMap::operator=(DenseMap&&) noexcept = default;

const std::vector<CloudPoint>& DenseMap::points() const {
  return impl_->points;
}
std::size_t DenseMap::n_views() const {
  return impl_->views.size();
}
std::size_t DenseMap::n_dropped_views() const {
  return impl_->n_dropped_views;
}
std::size_t DenseMap::n_carved_voxels() const {
  return impl_->n_carved_voxels;
}

void DenseMap::save_cloud(const std::string& path) const {
  write_ply(path, impl_->points);
}

void DenseMap::save_octomap(const std::string& path, double resolution_m) const {
  check_range("resolution_m", resolution_m, 0.01, 1.0);
  write_octomap(path, resolution_m, impl_->points, *impl_->camera, impl_->views);
}

bool DenseMap::can_save_octomap() {
  return has_octomap();
}

}  // namespace cpslam
