#include "dense/voxel_grid.h"

#include <algorithm>
#include <tuple>

namespace cpslam {
namespace {

constexpr int kAxisBits = 21;
constexpr int kHalfRange = 1 << (kAxisBits - 1);
constexpr VoxelKey kAxisMask = (VoxelKey{1} << kAxisBits) - 1;

Eigen::Vector3i cell_of(VoxelKey key) {
  const auto axis = [key](int i) {
    return static_cast<int>((key >> static_cast<unsigned>(kAxisBits * i)) & kAxisMask) - kHalfRange;
  };
  return {axis(2), axis(1), axis(0)};
}

auto order_of(const Voxel& voxel) {
  const auto block = [&](int axis) { return voxel.cell[axis] >> VoxelGrid::kBlockBits; };
  return std::tuple(block(0), block(1), block(2), voxel.cell[0], voxel.cell[1], voxel.cell[2]);
}

}  // namespace

VoxelKey voxel_key(const Eigen::Vector3i& cell) {
  const auto axis = [&](int i) {
    return static_cast<VoxelKey>(static_cast<std::int64_t>(cell[i]) + kHalfRange) & kAxisMask;
  };
  return axis(0) << static_cast<unsigned>(2 * kAxisBits) | axis(1) << static_cast<unsigned>(kAxisBits) |
         axis(2);
}

void VoxelGrid::add(const Eigen::Vector3d& position_m, const Eigen::Vector3f& normal,
                    const std::array<std::uint8_t, 3>& rgb, float weight) {
  const Eigen::Vector3d in_sides = position_m / side_m_;
  if (!(in_sides.array().abs() < kHalfRange - 1).all()) return;
  const Eigen::Vector3d corner = in_sides.array().floor();
  Sums& sums = sums_[voxel_key(corner.cast<int>())];
  sums.offset += weight * (in_sides - corner).cast<float>();
  sums.normal += weight * normal;
  sums.rgb += weight * Eigen::Vector3f(rgb[0], rgb[1], rgb[2]);
  sums.weight += weight;
}

std::vector<Voxel> VoxelGrid::voxels() const {
  std::vector<Voxel> voxels;
  voxels.reserve(sums_.size());
  for (const auto& [key, sums] : sums_) {
    if (!(sums.weight > 0.0F)) continue;
    Voxel voxel;
    voxel.cell = cell_of(key);
    const Eigen::Vector3d in_sides = voxel.cell.cast<double>() + (sums.offset / sums.weight).cast<double>();
    voxel.position_m = (in_sides * side_m_).cast<float>();
    voxel.normal = sums.normal.normalized();
    voxel.rgb = sums.rgb / sums.weight;
    voxel.weight = sums.weight;
    voxels.push_back(voxel);
  }
  std::sort(voxels.begin(), voxels.end(),
            [](const Voxel& a, const Voxel& b) { return order_of(a) < order_of(b); });
  return voxels;
}

}  // namespace cpslam
