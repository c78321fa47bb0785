#include "sim/smooth_curve.h"

#include <algorithm>
#include <cmath>

namespace cpslam::sim {
namespace {

Eigen::Vector2d catmull_rom(const Eigen::Vector2d& p0, const Eigen::Vector2d& p1, const Eigen::Vector2d& p2,
                            const Eigen::Vector2d& p3, double t) {
  return 0.5 * (2.0 * p1 + (p2 - p0) * t + (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) * t * t +
                (3.0 * p1 - p0 - 3.0 * p2 + p3) * t * t * t);
}

std::vector<Eigen::Vector2d> dense_points(const std::vector<Eigen::Vector2d>& points, bool closed) {
  const auto n = static_cast<std::ptrdiff_t>(points.size());
  const auto at = [&](std::ptrdiff_t i) {
    i = closed ? (i % n + n) % n : std::clamp<std::ptrdiff_t>(i, 0, n - 1);
    return points[static_cast<std::size_t>(i)];
  };
  std::vector<Eigen::Vector2d> dense;
  constexpr int kSteps = 200;
  for (std::ptrdiff_t i = 0; i < (closed ? n : n - 1); ++i)
    for (int k = 0; k < kSteps; ++k)
      dense.push_back(catmull_rom(at(i - 1), at(i), at(i + 1), at(i + 2), static_cast<double>(k) / kSteps));
  dense.push_back(closed ? points.front() : points.back());
  return dense;
}

}  // namespace

SmoothCurve::SmoothCurve(const std::vector<Eigen::Vector2d>& points, bool closed) : closed_(closed) {
  const std::vector<Eigen::Vector2d> dense = dense_points(points, closed);
  std::vector<double> distance{0.0};
  for (std::size_t i = 1; i < dense.size(); ++i)
    distance.push_back(distance.back() + (dense[i] - dense[i - 1]).norm());
  const double total = distance.back();
  const auto n = static_cast<std::size_t>(std::ceil(total / 0.01));
  step_m_ = total / static_cast<double>(n);
  std::size_t segment = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    const double s = std::min(total, step_m_ * static_cast<double>(i));
    while (segment + 2 < dense.size() && distance[segment + 1] < s) ++segment;
    const double t = (s - distance[segment]) / (distance[segment + 1] - distance[segment]);
    samples_.emplace_back(dense[segment] + t * (dense[segment + 1] - dense[segment]));
  }
}

Eigen::Vector2d SmoothCurve::position(double distance_m) const {
  const double length = length_m();
  double s = distance_m;
  if (closed_) {
    s = std::fmod(s, length);
    if (s < 0.0) s += length;
  }
  const double x = std::clamp(s, 0.0, length) / step_m_;
  const std::size_t i = std::min(static_cast<std::size_t>(x), samples_.size() - 2);
  const double t = x - static_cast<double>(i);
  return (1.0 - t) * samples_[i] + t * samples_[i + 1];
}

Eigen::Vector2d SmoothCurve::direction(double distance_m, double window_m) const {
  const double half = 0.5 * std::max(window_m, 2.0 * step_m_);
  return (position(distance_m + half) - position(distance_m - half)).normalized();
}

double SmoothCurve::closest(const Eigen::Vector2d& point) const {
  const auto nearer = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  };
  const auto it = std::min_element(samples_.begin(), samples_.end(), nearer);
  return step_m_ * static_cast<double>(it - samples_.begin());
}

}  // namespace cpslam::sim
