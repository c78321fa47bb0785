#pragma once

#include <imgui.h>

#include "viewer/colours.h"
#include "viewer/window.h"

namespace cpslam::viewer {

[[nodiscard]] inline ImU32 to_u32(Colour c) {
  return IM_COL32(c.red, c.green, c.blue, c.alpha);
}
[[nodiscard]] inline ImVec4 to_vec4(Colour c) {
  return ImGui::ColorConvertU32ToFloat4(to_u32(c));
}

/// Dear ImGui in a window, in the viewer's dress. One at a time; lives in the window's thread.
class Gui {
 public:
  explicit Gui(const Window& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  void begin_frame() const;
  /// Draws what was laid out since begin_frame().
  void draw_frame() const;

  [[nodiscard]] ImFont* heading() const { return heading_; }
  [[nodiscard]] ImFont* small() const { return small_; }
  /// Sizes are in units of this many pixels.
  [[nodiscard]] float scale() const { return scale_; }

 private:
  void load_fonts();
  void set_style() const;

  float scale_;
  ImFont* heading_ = nullptr;
  ImFont* small_ = nullptr;
};

}  // namespace cpslam::viewer
