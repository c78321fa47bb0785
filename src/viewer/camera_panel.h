#pragma once

#include <memory>

#include "cpslam/snapshot.h"
#include "viewer/gui.h"
#include "viewer/texture.h"

namespace cpslam::viewer {

/// The camera's image with what was seen in it, and the state. Lives in the thread of its OpenGL context.
class CameraPanel {
 public:
  void set_frame(std::shared_ptr<const FrameSnapshot> frame);
  /// Lays out in the current ImGui window.
  void draw(const Gui& gui) const;

 private:
  void draw_state(const Gui& gui) const;
  void draw_picture(const Gui& gui) const;
  void draw_seen(const Gui& gui, ImVec2 corner, float scale) const;
  void draw_legend(const Gui& gui) const;

  std::shared_ptr<const FrameSnapshot> frame_;
  Texture image_, people_;
  cv::Rect people_area_;  // of the image, that people_ covers
};

}  // namespace cpslam::viewer
