#pragma once

#include <optional>

#include "viewer/framing.h"
#include "viewer/orbit_camera.h"

namespace cpslam::viewer {

enum class ViewMode {
  kOverview,  ///< the whole map, however it grows
  kFollow,    ///< around what the camera that is tracked has before it
  kFree,      ///< as the user left it
};

/// Moves the eye: by itself, after the map or the camera, and by the mouse. No OpenGL in it.
class ViewControl {
 public:
  ViewControl() { reset(); }

  [[nodiscard]] const OrbitCamera& eye() const { return eye_; }
  [[nodiscard]] ViewMode mode() const { return mode_; }
  void set_mode(ViewMode mode);
  /// The overview from straight above.
  void look_from_above();
  /// The overview from where it was in the beginning.
  void reset();

  void set_map(const MapSnapshot& map);
  /// looks: where to, of unit length.
  void set_camera(const Eigen::Vector3d& position, const Eigen::Vector3d& looks);
  void set_aspect(double width_by_height) { aspect_ = width_by_height; }

  /// The mouse, as OrbitCamera has it. Panning and zooming leave the overview.
  void turn(double dx_px, double dy_px) { eye_.turn(dx_px, dy_px); }
  void pan(double dx_px, double dy_px, double height_px);
  void zoom(double notches);

  /// dt_s after the last call: glides to where the eye should be. Whether it is still on its way.
  bool glide(double dt_s);

 private:
  struct Aim {
    Eigen::Vector3d target;
    double distance_m;
  };
  [[nodiscard]] std::optional<Aim> aim() const;

  OrbitCamera eye_;
  ViewMode mode_ = ViewMode::kOverview;
  std::optional<Extent> extent_;
  std::optional<Eigen::Vector3d> before_camera_;
  double aspect_ = 1.0;
  double follow_distance_m_ = 3.5;
  bool arrived_once_ = false;
};

}  // namespace cpslam::viewer
