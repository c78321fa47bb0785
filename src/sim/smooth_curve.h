#pragma once

#include <Eigen/Core>
#include <vector>

namespace cpslam::sim {

/// A smooth path over the floor through given points (Catmull-Rom), by arc length.
class SmoothCurve {
 public:
  /// At least three points (m). A closed curve goes on from the last point to the first.
  SmoothCurve(const std::vector<Eigen::Vector2d>& points, bool closed);

  [[nodiscard]] double length_m() const { return step_m_ * static_cast<double>(samples_.size() - 1); }
  /// Closed curves go round; open ones end at their ends.
  [[nodiscard]] Eigen::Vector2d position(double distance_m) const;
  /// Unit vector, averaged over window_m around the place, so that it turns without jerks.
  [[nodiscard]] Eigen::Vector2d direction(double distance_m, double window_m) const;
  /// Distance of the place on the curve closest to a point.
  [[nodiscard]] double closest(const Eigen::Vector2d& point) const;

 private:
  bool closed_;
  double step_m_ = 0.0;
  std::vector<Eigen::Vector2d> samples_;  // equally spaced by arc length
};

}  // namespace cpslam::sim
