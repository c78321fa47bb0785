#pragma once

#include <sys/types.h>

namespace cpslam::test {

/// An X server without a screen (Xvfb) with software OpenGL. As long as it lives, DISPLAY names it for this
/// process and those it starts.
class VirtualDisplay {
 public:
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// False where there is no Xvfb, or it does not come up.
  [[nodiscard]] bool running() const { return running_; }
  static constexpr const char* kMissing = "needs Xvfb (Debian package xvfb)";

 private:
  pid_t pid_ = -1;
  bool running_ = false;
};

}  // namespace cpslam::test
