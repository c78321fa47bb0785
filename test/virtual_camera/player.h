#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <stop_token>

#include "util/worker.h"
#include "virtual_camera/film.h"

namespace cpslam::virtual_camera {

/// Where a stream's pictures go.
class PictureSink {
 public:
  virtual ~PictureSink() = default;
  virtual void deliver(const cv::Mat& picture, std::uint64_t time_us, int index) = 0;
};

/// Plays the film at the speed of its stamps to whoever listens, faults included, from a thread of its own.
class Player {
 public:
  /// plugged is called, in the player's thread, with false when the camera is unplugged, true when it is
  /// back.
  Player(CameraScript script, std::function<void(bool)> plugged);

  [[nodiscard]] const Film& film() const { return film_; }
  [[nodiscard]] const CameraScript& script() const { return script_; }
  [[nodiscard]] bool plugged() const;

  /// A sink gets pictures until it is null again; none is being delivered then any more.
  void set_colour_sink(PictureSink* sink);
  void set_depth_sink(PictureSink* sink);
  /// The device was opened: its stamps begin anew.
  void open();

 private:
  using Clock = std::chrono::steady_clock;
  void set(PictureSink*& slot, PictureSink* sink);
  void play(const std::stop_token& stop);
  void play_next(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  void be_unplugged(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  void deliver(const Film::Step& step);

  const CameraScript script_;
  const std::function<void(bool)> plugged_callback_;
  const Film film_;

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  PictureSink* colour_ = nullptr;
  PictureSink* depth_ = nullptr;
  bool plugged_ = true;
  bool stalled_ = false;
  std::size_t n_played_ = 0;
  std::uint64_t time_us_ = 0;
  Clock::time_point due_;
  Worker<int> worker_;  // last, so that its thread ends first
};

}  // namespace cpslam::virtual_camera
