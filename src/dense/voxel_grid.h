#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace cpslam {

/// A cube of space with the mean of the surface that lies in it.
struct Voxel {
  Eigen::Vector3i cell = Eigen::Vector3i::Zero();  ///< from cell * side to (cell + 1) * side
  Eigen::Vector3f position_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit
  Eigen::Vector3f rgb = Eigen::Vector3f::Zero();     ///< 0 to 255
  float weight = 0.0F;
};

/// Cells are addressed by 21 bits an axis.
using VoxelKey = std::uint64_t;
[[nodiscard]] VoxelKey voxel_key(const Eigen::Vector3i& cell);

/// Weighted means of positions, normals and colours per voxel, in a hash table. Not thread-safe.
class VoxelGrid {
 public:
  explicit VoxelGrid(double side_m) : side_m_(side_m) {}

  /// Leaves out what lies farther than 2^20 voxels from the origin, or nowhere.
  void add(const Eigen::Vector3d& position_m, const Eigen::Vector3f& normal,
           const std::array<std::uint8_t, 3>& rgb, float weight);

  /// By blocks of 8 x 8 x 8 and in them by cell, so that neighbours lie together and the order does not
  /// depend on hashes.
  [[nodiscard]] std::vector<Voxel> voxels() const;

  static constexpr int kBlockBits = 3;

 private:
  struct Sums {
    Eigen::Vector3f offset =
        Eigen::Vector3f::Zero();  // from the cell's corner, in sides: exact far away, too
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Eigen::Vector3f rgb = Eigen::Vector3f::Zero();
    float weight = 0.0F;
  };
  double side_m_;
  std::unordered_map<VoxelKey, Sums> sums_;
};

}  // namespace cpslam
