#pragma once

#include <memory>
#include <string>

namespace cpslam::test {

/// Who sits before a window of the VirtualDisplay: presses keys, closes it.
class WindowUser {
 public:
  /// Waits until a window of this name is there, for at most a minute; then throws std::runtime_error.
  explicit WindowUser(const std::string& name);
  ~WindowUser();
  WindowUser(const WindowUser&) = delete;
  WindowUser& operator=(const WindowUser&) = delete;

  /// As X11 names it: "space", "n".
  void press(const std::string& key) const;
  /// As a window manager's cross does.
  void close() const;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace cpslam::test
