#include "viewer/framing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/se3.h"

namespace cpslam::viewer {
namespace {

constexpr double kOutermost =
    0.06;  // of the points: beyond the ball; half of them at either end of each axis
constexpr std::size_t kSamples = 4000;

/// Some of the points.
std::vector<Eigen::Vector3d> sample_points(const MapSnapshot& map) {
  std::vector<Eigen::Vector3d> samples;
  const std::size_t step = std::max<std::size_t>(1, map.points.size() / kSamples);
  for (std::size_t i = 0; i < map.points.size(); i += step) {
    const WorldPoint& p = map.points[i];
    samples.emplace_back(p[0], p[1], p[2]);
  }
  return samples;
}

std::vector<Eigen::Vector3d> path_points(const MapSnapshot& map) {
  std::vector<Eigen::Vector3d> points;
  for (const StampedPose& pose : map.trajectory) {
    const auto& t = pose.world_from_camera.translation_m;
    points.emplace_back(t[0], t[1], t[2]);
  }
  return points;
}

/// The value below which a share of the measured points lie; there has to be one.
template <typename Measure>
double quantile(const std::vector<Eigen::Vector3d>& points, double share, const Measure& measure) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const Eigen::Vector3d& point : points) values.push_back(measure(point));
  const auto rank = static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace

std::optional<Extent> extent_of(const MapSnapshot& map, const Eigen::Vector3d& up) {
  const std::vector<Eigen::Vector3d> path = path_points(map);
  std::vector<Eigen::Vector3d> points = sample_points(map);
  if (points.empty()) points = path;
  if (points.empty()) return std::nullopt;
  Extent extent;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto along = [axis](const Eigen::Vector3d& p) { return p[axis]; };
    extent.centre[axis] =
        0.5 * (quantile(points, 0.5 * kOutermost, along) + quantile(points, 1.0 - 0.5 * kOutermost, along));
  }
  const auto distance = [&extent](const Eigen::Vector3d& p) { return (p - extent.centre).norm(); };
  extent.radius_m = quantile(points, 1.0 - kOutermost, distance);
  for (const Eigen::Vector3d& p : path) extent.radius_m = std::max(extent.radius_m, distance(p));
  extent.floor_m = quantile(points, 0.5 * kOutermost, [&up](const Eigen::Vector3d& p) { return up.dot(p); });
  return extent;
}

Eigen::Vector3d up_of(const MapSnapshot& map) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const StampedPose& keyframe : map.keyframes)
    sum -= from_pose(keyframe.world_from_camera).rotation.col(1);
  return sum.norm() > 1e-6 ? Eigen::Vector3d(sum.normalized()) : Eigen::Vector3d(-Eigen::Vector3d::UnitY());
}

}  // namespace cpslam::viewer
