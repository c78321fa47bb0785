#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cpslam {

struct DenseMapOptions {
  double voxel_m = 0.02;     ///< side of the cubes of which each gives at most one point, 0.005 to 0.5
  double max_depth_m = 4.0;  ///< surfaces farther from the camera are too noisy to be drawn, up to 13

  /// Throws InputError naming the member that is out of its range.
  void check() const;
};

/// A point of a surface, in the frame of the trajectories.
struct CloudPoint {
  std::array<float, 3> position_m{};
  std::array<float, 3> normal{};  ///< unit, towards the cameras that saw it
  std::array<std::uint8_t, 3> rgb{};
};

/// The room without its people: what keyframes saw of it, at their poses when this was made. Immutable.
class DenseMap {
 public:
  class Impl;
  explicit DenseMap(std::unique_ptr<const Impl> impl);  ///< for System
  ~DenseMap();
  DenseMap(DenseMap&&) noexcept;
  DenseMap& operator=(DenseMap&&) noexcept;

  [[nodiscard]] const std::vector<CloudPoint>& points() const;
  [[nodiscard]] std::size_t n_views() const;          ///< keyframes it is made of
  [[nodiscard]] std::size_t n_dropped_views() const;  ///< others, for DenseSettings::memory_mb
  /// Cubes that held readings, but that other keyframes saw through: people nobody noticed, moved chairs.
  [[nodiscard]] std::size_t n_carved_voxels() const;

  /// Writes the points as binary PLY: x y z nx ny nz red green blue. Throws RunError when that fails.
  void save_cloud(const std::string& path) const;

  /// Writes an OctoMap (.bt): occupied where points are, free where keyframes looked through, the rest
  /// unknown. resolution_m: side of its cells, 0.01 to 1. Throws InputError where the library was built
  /// without OctoMap or for a resolution out of range, RunError when writing fails.
  void save_octomap(const std::string& path, double resolution_m = 0.05) const;
  [[nodiscard]] static bool can_save_octomap();

 private:
  std::unique_ptr<const Impl> impl_;
};

}  // namespace cpslam
