#include "viewer/framing.h"

#include <algorithm>
#include <array>
#include <vector>

#include "geometry/se3.h"

namespace cpslam::viewer {
namespace {

constexpr double kOutermost = 0.03;  // of the points, at either end of each axis
constexpr std::size_t kSamples = 4000;

std::vector<WorldPoint> sample_points(const MapSnapshot& map) {
  std::vector<WorldPoint> samples;
  const std::size_t step = std::max<std::size_t>(1, map.points.size() / kSamples);
  for (std::size_t i = 0; i < map.points.size(); i += step) samples.push_back(map.points[i]);
  return samples;
}

/// The value below which a share of the coordinates lie.
double quantile(std::vector<WorldPoint>& points, std::size_t axis, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(points.size() - 1));
  std::nth_element(points.begin(), points.begin() + rank, points.end(),
                   [axis](const WorldPoint& a, const WorldPoint& b) { return a[axis] < b[axis]; });
  return points[static_cast<std::size_t>(rank)][axis];
}

}  // namespace

std::optional<Extent> extent_of(const MapSnapshot& map) {
  if (map.points.empty() && map.trajectory.empty()) return std::nullopt;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
  std::vector<WorldPoint> samples = sample_points(map);
  for (std::size_t axis = 0; axis < 3 && !samples.empty(); ++axis) {
    low[static_cast<Eigen::Index>(axis)] = quantile(samples, axis, kOutermost);
    high[static_cast<Eigen::Index>(axis)] = quantile(samples, axis, 1.0 - kOutermost);
  }
  for (const StampedPose& pose : map.trajectory) {
    const Eigen::Vector3d at(pose.world_from_camera.translation_m.data());
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  return Extent{0.5 * (low + high), 0.5 * (high - low).norm()};
}

Eigen::Vector3d up_of(const MapSnapshot& map) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const StampedPose& keyframe : map.keyframes)
    sum -= from_pose(keyframe.world_from_camera).rotation.col(1);
  return sum.norm() > 1e-6 ? Eigen::Vector3d(sum.normalized()) : Eigen::Vector3d(-Eigen::Vector3d::UnitY());
}

}  // namespace cpslam::viewer
