#include "viewer/view_control.h"

#include <algorithm>
#include <cmath>

namespace cpslam::viewer {
namespace {

constexpr double kYawRad = -0.4;
constexpr double kPitchRad = 0.7;
constexpr double kGlidePerS = 5.0;
constexpr double kAheadM = 1.2;    // what is looked at is more than who looks
constexpr double kNear = 0.002;    // of the distance: there
constexpr double kRoom = 1.0;      // around the map: its ball has corners to spare
constexpr double kNotable = 0.04;  // of the map's radius: by less the overview does not move

bool is_notable(const Extent& before, const Extent& now) {
  return (now.centre - before.centre).norm() > kNotable * before.radius_m ||
         std::abs(now.radius_m - before.radius_m) > kNotable * before.radius_m;
}

}  // namespace

void ViewControl::set_mode(ViewMode mode) {
  mode_ = mode;
}

void ViewControl::look_from_above() {
  eye_.set_angles(0.0, 1.5);
  mode_ = ViewMode::kOverview;
}

void ViewControl::reset() {
  eye_.set_angles(kYawRad, kPitchRad);
  mode_ = ViewMode::kOverview;
}

void ViewControl::set_map(const MapSnapshot& map) {
  const Eigen::Vector3d up = up_of(map);
  const std::optional<Extent> extent = extent_of(map, up);
  // A map grows all the time. An eye that always follows never rests, and each of its moves is a drawing of
  // the whole map.
  if (!extent || !extent_ || is_notable(*extent_, *extent)) extent_ = extent;
  eye_.set_up(up);
}

void ViewControl::set_camera(const Eigen::Vector3d& position, const Eigen::Vector3d& looks) {
  before_camera_ = position + kAheadM * looks;
}

void ViewControl::pan(double dx_px, double dy_px, double height_px) {
  mode_ = ViewMode::kFree;
  eye_.pan(dx_px, dy_px, height_px);
}

void ViewControl::zoom(double notches) {
  if (mode_ == ViewMode::kOverview) mode_ = ViewMode::kFree;
  eye_.zoom(notches);
  if (mode_ == ViewMode::kFollow) follow_distance_m_ = eye_.distance_m();
}

std::optional<ViewControl::Aim> ViewControl::aim() const {
  if (mode_ == ViewMode::kFollow && before_camera_) return Aim{*before_camera_, follow_distance_m_};
  if (mode_ == ViewMode::kOverview && extent_) {
    const double radius_m = std::max(0.3, kRoom * extent_->radius_m);
    return Aim{extent_->centre, OrbitCamera::distance_to_see(radius_m, aspect_)};
  }
  return std::nullopt;
}

bool ViewControl::glide(double dt_s) {
  const std::optional<Aim> to = aim();
  if (!to) return false;
  const double share = arrived_once_ ? 1.0 - std::exp(-kGlidePerS * dt_s) : 1.0;
  arrived_once_ = true;
  const Eigen::Vector3d target = eye_.target() + share * (to->target - eye_.target());
  const double distance_m = eye_.distance_m() + share * (to->distance_m - eye_.distance_m());
  eye_.set_target(target);
  eye_.set_distance(distance_m);
  const double off_m = (to->target - target).norm() + std::abs(to->distance_m - distance_m);
  return off_m > kNear * distance_m;
}

}  // namespace cpslam::viewer
