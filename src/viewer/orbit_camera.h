#pragma once

#include <Eigen/Core>

namespace cpslam::viewer {

/// The eye that looks at the map: turns around a target. World in metres; the map's axes are those of the
/// first camera (x right, y down, z forward), its up whatever set_up says.
class OrbitCamera {
 public:
  /// up: need not be of unit length, but not zero.
  void set_up(const Eigen::Vector3d& up);
  void set_target(const Eigen::Vector3d& target) { target_ = target; }
  void set_distance(double distance_m);
  /// yaw: to the right, of the direction of looking; pitch: from above, positive downwards. rad
  void set_angles(double yaw_rad, double pitch_rad);

  /// By the mouse: px of a drag, in a view of this height; notches of the wheel.
  void turn(double dx_px, double dy_px);
  void pan(double dx_px, double dy_px, double height_px);
  void zoom(double notches);

  [[nodiscard]] const Eigen::Vector3d& target() const { return target_; }
  [[nodiscard]] double distance_m() const { return distance_m_; }
  [[nodiscard]] Eigen::Vector3d eye() const;
  /// OpenGL's eye from world: x right, y up, looking along -z.
  [[nodiscard]] Eigen::Matrix4f eye_from_world() const;
  /// OpenGL's clip from eye. aspect: width by height.
  [[nodiscard]] Eigen::Matrix4f clip_from_eye(double aspect) const;
  /// The distance from which a ball of this radius fills the view.
  [[nodiscard]] static double distance_to_see(double radius_m, double aspect);
  /// How many pixels high a metre looks at a metre's distance.
  [[nodiscard]] static double focal_px(double height_px);

 private:
  /// Columns: right, up, backwards (towards the eye), in the world.
  [[nodiscard]] Eigen::Matrix3d axes() const;

  Eigen::Vector3d up_ = -Eigen::Vector3d::UnitY();
  Eigen::Vector3d target_ = Eigen::Vector3d::Zero();
  double distance_m_ = 5.0;
  double yaw_rad_ = 0.0;
  double pitch_rad_ = 0.5;
};

}  // namespace cpslam::viewer
