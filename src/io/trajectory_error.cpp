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

/// Positions at the same times.
struct PositionPairs {
  std::vector<Eigen::Vector3d> truth, estimate;
};

PositionPairs associate(const Trajectory& truth, const Trajectory& estimate, double max_difference_s) {
  PositionPairs pairs;
  for (const auto& [i, j] : associate_stamps(stamps_of(truth), stamps_of(estimate), max_difference_s)) {
    pairs.truth.push_back(position(truth[i]));
    pairs.estimate.push_back(position(estimate[j]));
  }
  return pairs;
}

}  // namespace

TrajectoryError absolute_trajectory_error(const Trajectory& truth, const Trajectory& estimate,
                                          double max_difference_s) {
  const PositionPairs pairs = associate(truth, estimate, max_difference_s);
  TrajectoryError result;
  result.pairs = pairs.truth.size();
  if (result.pairs < 3) return result;
  const SE3 truth_from_estimate = align_points(pairs.estimate, pairs.truth);
  std::vector<double> errors;
  for (std::size_t i = 0; i < pairs.truth.size(); ++i) {
    errors.push_back((pairs.truth[i] - truth_from_estimate * pairs.estimate[i]).norm());
  }
  std::sort(errors.begin(), errors.end());
  const auto count = static_cast<double>(errors.size());
  result.rmse_m = std::sqrt(std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0) / count);
  result.mean_m = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  result.median_m = median_of_sorted(errors);
  result.max_m = errors.back();
  return result;
}

std::optional<SE3> align_to_estimate(const Trajectory& truth, const Trajectory& estimate,
                                     double max_difference_s) {
  const PositionPairs pairs = associate(truth, estimate, max_difference_s);
  if (pairs.truth.size() < 3) return std::nullopt;
  return align_points(pairs.truth, pairs.estimate);
}

}  // namespace cpslam
