#include "viewer/window.h"

#include <epoxy/gl.h>
// GLFW must not bring its own OpenGL header.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cstdlib>
#include <utility>

#include "cpslam/error.h"

namespace cpslam::viewer {
namespace {

std::string last_problem() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "no reason given";
}

/// GLFW 3.4 tries Wayland first, and where there is none the library below it complains to stderr.
void choose_platform() {
#ifdef GLFW_PLATFORM
  if (std::getenv("WAYLAND_DISPLAY") == nullptr) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
}

Window& window_of(GLFWwindow* handle) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
}

}  // namespace

Window::Window(const std::string& title, cv::Size size) {
  choose_platform();
  if (glfwInit() != GLFW_TRUE) {
    throw RunError("the viewer cannot be shown: " + last_problem() +
                   " (is there a display? without one: xvfb-run -a PROGRAM ...)");
  }
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);  // with one beside it, Mesa clears the depth in twice the time
  window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string problem = last_problem();
    glfwTerminate();
    throw RunError("the viewer needs OpenGL 3.3: " + problem);
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(0);  // the loop paces itself, and must not hang on a screen that is switched off
  glfwSetWindowUserPointer(window_, this);
  install_callbacks();
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::install_callbacks() {
  glfwSetKeyCallback(window_, [](GLFWwindow* handle, int key, int, int action, int) {
    Window& window = window_of(handle);
    window.active_ = true;
    if (action == GLFW_RELEASE) return;
    if (key == GLFW_KEY_ESCAPE) window.keys_.push_back('\x1b');
    if (key == GLFW_KEY_SPACE || (key >= GLFW_KEY_0 && key <= GLFW_KEY_Z))
      window.keys_.push_back(static_cast<char>(key));
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double, double) { window_of(w).active_ = true; });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int, int, int) { window_of(w).active_ = true; });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double) { window_of(w).active_ = true; });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { window_of(w).active_ = true; });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { window_of(w).active_ = true; });
}

void Window::wait_for_events(double timeout_s) {
  glfwWaitEventsTimeout(timeout_s);
}

void Window::show_drawn() {
  glfwSwapBuffers(window_);
}

bool Window::close_requested() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::request_close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

bool Window::take_activity() {
  return std::exchange(active_, false);
}

std::vector<char> Window::take_keys() {
  return std::exchange(keys_, {});
}

cv::Size Window::frame_size() const {
  cv::Size size;
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return size;
}

double Window::pixel_ratio() const {
  int width = 0;
  int height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return width > 0 ? static_cast<double>(frame_size().width) / width : 1.0;
}

double Window::content_scale() const {
  float x = 1.0F;
  float y = 1.0F;
  glfwGetWindowContentScale(window_, &x, &y);
  return x;
}

}  // namespace cpslam::viewer
