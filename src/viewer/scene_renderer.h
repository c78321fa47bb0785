#pragma once

#include <cstddef>
#include <opencv2/core/types.hpp>
#include <optional>

#include "cpslam/settings.h"
#include "cpslam/snapshot.h"
#include "viewer/offscreen_picture.h"
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
  bool operator==(const Layers&) const = default;
};

/// Draws snapshots of the map and of the current frame. The map, which is most of the work, is drawn off
/// screen and kept until it or the eye changes; what belongs to the frame is laid over it and never hidden by
/// it. Where the processor has to draw, a large map shows only some of its points. Lives in the thread of its
/// OpenGL context.
class SceneRenderer {
 public:
  explicit SceneRenderer(const CameraSettings& camera);

  /// up: of the world; truth: in the map's world, empty when there is none.
  void set_map(const MapSnapshot& map, const Eigen::Vector3d& up, const Trajectory& truth);
  void set_frame(const FrameSnapshot& frame);

  /// area_px: of the window, from its lower left corner; its depth has to be cleared. scale: of lines and
  /// points, 1 on common screens.
  void draw(const OrbitCamera& eye, const cv::Rect& area_px, double scale, const Layers& layers);

 private:
  /// All that the picture of the map depends on besides the map.
  struct View {
    Eigen::Matrix4f eye_from_world, clip_from_eye;
    float focal_px = 0.0F;
    float distance_m = 0.0F;
    cv::Size size;
    double scale = 1.0;
    Layers layers;
    bool operator==(const View&) const = default;
  };
  struct PointLook;

  void draw_map(const View& view);
  void draw_frame(const View& view) const;
  void draw_points(const View& view, const ShaderProgram& shader, const PointStore& points,
                   const PointLook& look) const;
  void begin_lines(const View& view) const;
  void draw_lines(const View& view, const SegmentStore& lines, double width_px) const;
  void set_people(const FrameSnapshot& frame);

  CameraSettings camera_;
  std::size_t most_points_;
  ShaderProgram square_shader_;
  ShaderProgram round_shader_;
  ShaderProgram line_shader_;
  PointStore points_, tracked_points_, people_;
  SegmentStore keyframes_, covisibility_, spanning_tree_, loops_, trajectory_, truth_, current_, motion_,
      grid_;
  OffscreenPicture map_picture_;
  std::optional<View> pictured_;  // what map_picture_ shows; empty when the map is another one by now
  Eigen::Vector3d up_ = -Eigen::Vector3d::UnitY();
  float person_spacing_m_ = 0.03F;
  double current_depth_m_ = 0.3;
};

}  // namespace cpslam::viewer
