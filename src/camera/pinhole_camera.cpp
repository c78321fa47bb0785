#include "camera/pinhole_camera.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace cpslam {
namespace {

struct Distortion {
  Eigen::Vector2d value;       // distorted normalised coordinates
  Eigen::Matrix2d derivative;  // by the undistorted ones
};

}  // namespace

PinholeCamera::PinholeCamera(const CameraSettings& s)
    : width_(s.width),
      height_(s.height),
      fx_(s.fx),
      fy_(s.fy),
      cx_(s.cx),
      cy_(s.cy),
      bf_(s.bf),
      k1_(s.k1),
      k2_(s.k2),
      p1_(s.p1),
      p2_(s.p2),
      k3_(s.k3),
      has_distortion_(s.k1 != 0.0 || s.k2 != 0.0 || s.p1 != 0.0 || s.p2 != 0.0 || s.k3 != 0.0) {
  bounds_ = {0.0, 0.0, static_cast<double>(width_), static_cast<double>(height_)};
  if (!has_distortion_) return;
  constexpr double kInf = std::numeric_limits<double>::infinity();
  bounds_ = {kInf, kInf, -kInf, -kInf};
  // The extremes of a smooth distortion lie on the rim, not always in the corners.
  const auto include = [this](double x, double y) {
    const Eigen::Vector2d u = undistort({x, y});
    bounds_ = {std::min(bounds_[0], u.x()), std::min(bounds_[1], u.y()), std::max(bounds_[2], u.x()),
               std::max(bounds_[3], u.y())};
  };
  for (int x = 0; x <= width_; ++x) {
    include(x, 0.0);
    include(x, height_);
  }
  for (int y = 0; y <= height_; ++y) {
    include(0.0, y);
    include(width_, y);
  }
}

Eigen::Vector2d PinholeCamera::distort(const Eigen::Vector2d& undistorted_px) const {
  if (!has_distortion_) return undistorted_px;
  const double x = (undistorted_px.x() - cx_) / fx_;
  const double y = (undistorted_px.y() - cy_) / fy_;
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1_ + r2 * (k2_ + r2 * k3_));
  return {fx_ * (x * radial + 2.0 * p1_ * x * y + p2_ * (r2 + 2.0 * x * x)) + cx_,
          fy_ * (y * radial + p1_ * (r2 + 2.0 * y * y) + 2.0 * p2_ * x * y) + cy_};
}

Eigen::Vector2d PinholeCamera::undistort(const Eigen::Vector2d& distorted_px) const {
  if (!has_distortion_) return distorted_px;
  const Eigen::Vector2d target((distorted_px.x() - cx_) / fx_, (distorted_px.y() - cy_) / fy_);
  const auto distortion = [this](const Eigen::Vector2d& p) {
    const double x = p.x();
    const double y = p.y();
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1_ + r2 * (k2_ + r2 * k3_));
    const double radial_by_r2 = k1_ + r2 * (2.0 * k2_ + 3.0 * r2 * k3_);
    Distortion d;
    d.value = {x * radial + 2.0 * p1_ * x * y + p2_ * (r2 + 2.0 * x * x),
               y * radial + p1_ * (r2 + 2.0 * y * y) + 2.0 * p2_ * x * y};
    const double cross = 2.0 * x * y * radial_by_r2 + 2.0 * p1_ * x + 2.0 * p2_ * y;
    d.derivative << radial + 2.0 * x * x * radial_by_r2 + 2.0 * p1_ * y + 6.0 * p2_ * x, cross, cross,
        radial + 2.0 * y * y * radial_by_r2 + 6.0 * p1_ * y + 2.0 * p2_ * x;
    return d;
  };
  Eigen::Vector2d p = target;
  for (int i = 0; i < 20; ++i) {
    const Distortion d = distortion(p);
    const Eigen::Vector2d residual = target - d.value;
    // Newton where the model is invertible; strong calibrations fold over beyond the image corners, and there
    // the damped step of the fixed-point iteration stays finite.
    const bool invertible = d.derivative.determinant() > 0.05;
    const Eigen::Vector2d step =
        invertible ? Eigen::Vector2d(d.derivative.inverse() * residual) : Eigen::Vector2d(0.5 * residual);
    p += step;
    if (step.squaredNorm() < 1e-22) break;
  }
  return {fx_ * p.x() + cx_, fy_ * p.y() + cy_};
}

}  // namespace cpslam
