#include "dense/thinning.h"

#include <cmath>
#include <optional>
#include <unordered_map>

namespace cpslam {
namespace {

constexpr int kReach = 2;             // voxels to each side
constexpr float kSameSurface = 0.5F;  // cosine between normals

using Index = std::unordered_map<VoxelKey, std::size_t>;

/// The layer that stands for all around; empty when that is another one.
std::optional<Voxel> merged(const std::vector<Voxel>& voxels, const Index& index, std::size_t i) {
  const Voxel& voxel = voxels[i];
  Eigen::Index axis = 0;
  voxel.normal.cwiseAbs().maxCoeff(&axis);
  Eigen::Vector3f position = voxel.weight * voxel.position_m;
  Eigen::Vector3f normal = voxel.weight * voxel.normal;
  Eigen::Vector3f rgb = voxel.weight * voxel.rgb;
  float weight = voxel.weight;
  for (int step = -kReach; step <= kReach; ++step) {
    Eigen::Vector3i cell = voxel.cell;
    cell[axis] += step;
    const auto found = index.find(voxel_key(cell));
    if (step == 0 || found == index.end()) continue;
    const Voxel& other = voxels[found->second];
    if (voxel.normal.dot(other.normal) < kSameSurface) continue;
    if (other.weight > voxel.weight || (other.weight == voxel.weight && step < 0)) return std::nullopt;
    position += other.weight * other.position_m;
    normal += other.weight * other.normal;
    rgb += other.weight * other.rgb;
    weight += other.weight;
  }
  Voxel layer = voxel;
  layer.position_m = position / weight;
  layer.normal = normal.normalized();
  layer.rgb = rgb / weight;
  layer.weight = weight;
  return layer;
}

}  // namespace

std::vector<Voxel> thin(const std::vector<Voxel>& voxels) {
  Index index;
  index.reserve(voxels.size());
  for (std::size_t i = 0; i < voxels.size(); ++i) index.emplace(voxel_key(voxels[i].cell), i);
  std::vector<Voxel> thinned;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (std::optional<Voxel> layer = merged(voxels, index, i)) thinned.push_back(*std::move(layer));
  }
  return thinned;
}

}  // namespace cpslam
