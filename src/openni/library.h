#pragma once

#include <chrono>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace cpslam {

/// OpenNI2, for as long as one of these lives. Loads the drivers, which look for cameras.
class OpenNiLibrary {
 public:
  /// Throws RunError when the library does not start.
  OpenNiLibrary();
  ~OpenNiLibrary();
  OpenNiLibrary(const OpenNiLibrary&) = delete;
  OpenNiLibrary& operator=(const OpenNiLibrary&) = delete;
};

/// Keeps OpenNI2 running and notices cameras that are plugged in.
class CameraWatch {
 public:
  CameraWatch();
  ~CameraWatch();
  CameraWatch(const CameraWatch&) = delete;
  CameraWatch& operator=(const CameraWatch&) = delete;

  /// Waits until a camera is plugged in, the patience is at its end or the token is stopped. Not every
  /// camera's driver tells.
  void wait_for_camera(std::chrono::duration<double> patience, const std::stop_token& stop);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What OpenNI2 says about the last thing that failed, in one line; empty when it says nothing.
[[nodiscard]] std::string openni_error();

struct CameraInfo {
  std::string uri;
  std::string vendor;
  std::string name;
};

/// The cameras that are plugged in. Throws RunError as OpenNiLibrary does.
[[nodiscard]] std::vector<CameraInfo> list_cameras();

}  // namespace cpslam
