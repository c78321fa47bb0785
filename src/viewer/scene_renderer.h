#pragma once

#include <cstddef>
#include <opencv2/core/types.hpp>

#include "cpslam/settings.h"
#include "cpslam/snapshot.h"
#include "viewer/orbit_camera.h"
#include "viewer/shader_program.h"
#include "viewer/vertex_store.h"

namespace cpslam::viewer {

/// What of the scene is shown.
struct Layers {
  bool grid = true;
  bool points = true;
  bool keyframes = true;
  bool covisibility = true;
  bool spanning_tree = false;
  bool loops = true;
  bool trajectory = true;
  bool truth = true;
  bool people = true;
};

/// Draws snapshots of the map and of the current frame; of a large map only some of the points where the
/// processor has to draw them. Lives in the thread of its OpenGL context.
class SceneRenderer {
 public:
  explicit SceneRenderer(const CameraSettings& camera);

  /// up: of the world; truth: in the map's world, empty when there is none.
  void set_map(const MapSnapshot& map, const Eigen::Vector3d& up, const Trajectory& truth);
  void set_frame(const FrameSnapshot& frame);

  /// area_px: of the window, from its lower left corner; scale: of lines and points, 1 on common screens.
  void draw(const OrbitCamera& eye, const cv::Rect& area_px, double scale, const Layers& layers) const;

 private:
  void draw_points(const OrbitCamera& eye, double height_px, double aspect, double scale,
                   const Layers& layers) const;
  void draw_lines(const OrbitCamera& eye, const cv::Rect& area_px, double scale, const Layers& layers) const;
  void set_people(const FrameSnapshot& frame);

  CameraSettings camera_;
  std::size_t most_points_;
  ShaderProgram square_shader_;
  ShaderProgram round_shader_;
  ShaderProgram line_shader_;
  PointStore points_, tracked_points_, people_;
  SegmentStore keyframes_, covisibility_, spanning_tree_, loops_, trajectory_, truth_, current_, motion_,
      grid_;
  Eigen::Vector3d up_ = -Eigen::Vector3d::UnitY();
  float person_spacing_m_ = 0.03F;
  double current_depth_m_ = 0.3;
};

}  // namespace cpslam::viewer
