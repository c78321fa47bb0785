#include "dense/octomap_file.h"

#include "cpslam/error.h"

#ifdef CPSLAM_HAS_OCTOMAP

#include <octomap/octomap.h>

#include <sstream>

#include "io/atomic_file.h"

namespace cpslam {
namespace {

/// Every so many blocks of a view one ray is followed: at 4 m 5 cm apart with 640 px across.
constexpr int kRayStep = 4;

octomap::point3d to_octomap(const Eigen::Vector3f& p) {
  return {p.x(), p.y(), p.z()};
}

/// Adds the cells that a view looked through.
void add_free_cells(const octomap::OcTree& tree, const DenseCamera& camera, const PlacedView& placed,
                    octomap::KeyRay& ray, octomap::KeySet& free) {
  const Eigen::Matrix3f rotation = placed.world_from_view.rotation.cast<float>();
  const Eigen::Vector3f origin = placed.world_from_view.translation.cast<float>();
  const cv::Mat1w& depth = placed.view->depth;
  for (int y = kRayStep / 2; y < depth.rows; y += kRayStep) {
    for (int x = kRayStep / 2; x < depth.cols; x += kRayStep) {
      const int pixel = y * depth.cols + x;
      const float depth_m = placed.view->depth_m(pixel);
      if (depth_m <= 0.0F) continue;
      const Eigen::Vector3f end = rotation * (camera.ray(pixel) * depth_m) + origin;
      if (tree.computeRayKeys(to_octomap(origin), to_octomap(end), ray)) free.insert(ray.begin(), ray.end());
    }
  }
}

}  // namespace

bool has_octomap() {
  return true;
}

void write_octomap(const std::string& path, double resolution_m, std::span<const CloudPoint> points,
                   const DenseCamera& camera, const std::vector<PlacedView>& views) {
  octomap::OcTree tree(resolution_m);
  octomap::KeySet free;
  octomap::KeyRay ray;
  for (const PlacedView& view : views) add_free_cells(tree, camera, view, ray, free);
  constexpr bool kLazily = true;  // inner nodes once, at the end
  for (const octomap::OcTreeKey& key : free) tree.setNodeValue(key, tree.getClampingThresMinLog(), kLazily);
  for (const CloudPoint& point : points) {
    octomap::OcTreeKey key;
    const auto& [x, y, z] = point.position_m;
    if (tree.coordToKeyChecked(octomap::point3d(x, y, z), key))
      tree.setNodeValue(key, tree.getClampingThresMaxLog(), kLazily);
  }
  tree.updateInnerOccupancy();
  tree.prune();
  std::ostringstream bytes;
  // OcTree::writeBinary would do the same and print what it does.
  bytes << "# Octomap OcTree binary file\nid " << tree.getTreeType() << "\nsize " << tree.size() << "\nres "
        << resolution_m << "\ndata\n";
  tree.writeBinaryData(bytes);
  write_file_atomically(path, bytes.view());
}

}  // namespace cpslam

#else

namespace cpslam {

bool has_octomap() {
  return false;
}

void write_octomap(const std::string& path, double /*resolution_m*/, std::span<const CloudPoint> /*points*/,
                   const DenseCamera& /*camera*/, const std::vector<PlacedView>& /*views*/) {
  throw InputError("cannot write '" + path +
                   "': CP-SLAM was built without OctoMap; install liboctomap-dev and build it again");
}

}  // namespace cpslam

#endif
