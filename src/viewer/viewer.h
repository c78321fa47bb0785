#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>

#include "cpslam/settings.h"
#include "cpslam/snapshot.h"
#include "util/run_control.h"
#include "viewer/camera_panel.h"
#include "viewer/gui.h"
#include "viewer/map_panel.h"
#include "viewer/scene_renderer.h"
#include "viewer/timing_history.h"
#include "viewer/view_control.h"
#include "viewer/window.h"

namespace cpslam::viewer {

struct ViewerOptions {
  CameraSettings camera;
  Trajectory truth;           ///< of the whole sequence, in a world of its own; empty when there is none
  bool can_pause = true;      ///< not with a live camera
  bool localization = false;  ///< Settings::localization
  std::string screenshot_folder = ".";
  /// Not empty: when the run has ended, the window's picture goes into this PNG file and the window closes.
  std::string final_picture;
  cv::Size size{1600, 900};
};

/// The window that shows what a System lays down on a board, and lets the user steer the run. GLFW's windows
/// live in the main thread, so the run has to be in another one. One at a time.
class Viewer {
 public:
  /// Throws RunError when there is no display or no OpenGL 3.3.
  Viewer(ViewerOptions options, std::shared_ptr<SnapshotBoard> board, RunControl& control);

  /// Draws until the window is closed, then has the run quit. run_ended: asked between frames; the window
  /// stays when it has, to be looked at. interrupted: closes the window. Throws RunError when the final
  /// picture cannot be written.
  void run(const std::function<bool()>& run_ended, const std::function<bool()>& interrupted);

  /// Draws one frame of the window, wanted or not: to measure what that costs.
  void draw_once();

  /// So many windows are drawn in a second at most: when a new frame has come; while only something moves or
  /// ImGui settles.
  static constexpr double kMaxNewPerS = 60.0;
  static constexpr double kMaxPerS = 30.0;

 private:
  using Clock = std::chrono::steady_clock;

  bool take_snapshots();
  void take_map(const MapSnapshot& map);
  void request_snapshots();
  void handle_keys();
  void pause_or_go_on();
  void step();
  void switch_localization();
  /// The map goes at the second press within four seconds, because there is no way back.
  void reset_map();
  void disarm_reset();
  [[nodiscard]] RunFacts run_facts() const;
  void handle_mouse();
  [[nodiscard]] bool is_due() const;
  void draw();
  void lay_out();
  void save_screenshot();
  [[nodiscard]] ImVec2 map_corner() const;

  const ViewerOptions options_;
  const std::shared_ptr<SnapshotBoard> board_;
  RunControl& control_;
  Window window_;
  Gui gui_;
  SceneRenderer scene_;
  CameraPanel camera_panel_;
  TimingHistory timings_;
  ViewControl view_;
  Layers layers_;
  MapFacts facts_;
  std::shared_ptr<const FrameSnapshot> frame_;
  std::shared_ptr<const MapSnapshot> map_;
  Clock::time_point map_taken_, drawn_;
  std::optional<Clock::time_point> reset_armed_;  // when reset was pressed once
  std::optional<bool> wished_localization_;       // until a frame says how it is
  bool ended_ = false;                            // no more frames come
  bool new_frame_ = false;                        // is there and not drawn yet
  int stale_draws_ = 0;  // draws to come although nothing is new: ImGui settles over a few frames
  bool wants_screenshot_ = false;
};

}  // namespace cpslam::viewer
