#include "io/trajectory_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "geometry/alignment.h"
#include "io/association.h"

namespace cpslam {
namespace {

std::vector<double> stamps_of(const Trajectory& trajectory) {
  std::vector<double> stamps;
  stamps.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory) stamps.push_back(pose.time_s);
  return stamps;
}

Eigen::Vector3d position(const StampedPose& pose) {
  const auto& t = pose.world_from_camera.translation_m;
  return {t[0], t[1], t[2]};
}

double median_of_sorted(const std::vector<double>& values) {
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace

TrajectoryError absolute_trajectory_error(const Trajectory& truth, const Trajectory& estimate,
                                          double max_difference_s) {
  std::vector<Eigen::Vector3d> truth_points;
  std::vector<Eigen::Vector3d> estimate_points;
  for (const auto& [i, j] : associate_stamps(stamps_of(truth), stamps_of(estimate), max_difference_s)) {
    truth_points.push_back(position(truth[i]));
    estimate_points.push_back(position(estimate[j]));
  }
  TrajectoryError result;
  result.pairs = truth_points.size();
  if (result.pairs < 3) return result;
  const SE3 truth_from_estimate = align_points(estimate_points, truth_points);
  std::vector<double> errors;
  for (std::size_t i = 0; i < truth_points.size(); ++i) {
    errors.push_back((truth_points[i] - truth_from_estimate * estimate_points[i]).norm());
  }
  std::sort(errors.begin(), errors.end());
  const auto count = static_cast<double>(errors.size());
  result.rmse_m = std::sqrt(std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0) / count);
  result.mean_m = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  result.median_m = median_of_sorted(errors);
  result.max_m = errors.back();
  return result;
}

}  // namespace cpslam
