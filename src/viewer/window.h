#pragma once

#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

struct GLFWwindow;

namespace cpslam::viewer {

/// A window with an OpenGL 3.3 core context. GLFW wants its windows in the main thread; one at a time.
class Window {
 public:
  /// Throws RunError that says what is missing: a display, or OpenGL 3.3.
  Window(const std::string& title, cv::Size size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Waits for input, at most this long, and takes what has come.
  void wait_for_events(double timeout_s);
  void show_drawn();

  [[nodiscard]] bool close_requested() const;
  void request_close();
  /// Whether there was any input since this was asked last.
  [[nodiscard]] bool take_activity();
  /// The letters of the keys pressed since this was asked last; ' ' for the space bar, '\x1b' for escape.
  [[nodiscard]] std::vector<char> take_keys();

  /// Of what is drawn, px.
  [[nodiscard]] cv::Size frame_size() const;
  /// Pixels of what is drawn by unit of the mouse's coordinates (2 on some screens of high resolution).
  [[nodiscard]] double pixel_ratio() const;
  /// How much larger than on a common screen text is to be.
  [[nodiscard]] double content_scale() const;
  [[nodiscard]] GLFWwindow* handle() const { return window_; }

 private:
  void install_callbacks();
  GLFWwindow* window_ = nullptr;
  bool active_ = true;
  std::vector<char> keys_;
};

}  // namespace cpslam::viewer
