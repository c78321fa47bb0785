#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>

namespace cpslam::program {

/// Plays a recorded sequence at the speed of its time stamps. One thread.
class FramePacer {
 public:
  /// Waits until the frame is due; the first frame is due at once. False when the frame is so late that its
  /// successor, nominal_interval_s later, is due already: a live camera would have replaced it.
  bool wait_for(double time_s, double nominal_interval_s) {
    const auto now = std::chrono::steady_clock::now();
    if (!first_time_s_) {
      first_time_s_ = time_s;
      start_ = now;
    }
    const auto due = start_ + to_duration(time_s - *first_time_s_);
    if (now > due + to_duration(nominal_interval_s)) return false;
    std::unique_lock lock(mutex_);
    never_.wait_until(lock, due, [] { return false; });
    return true;
  }

  /// The clock stood still meanwhile.
  void delay(std::chrono::steady_clock::duration pause) { start_ += pause; }

 private:
  static std::chrono::steady_clock::duration to_duration(double seconds) {
    return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(seconds));
  }

  std::optional<double> first_time_s_;
  std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
  std::condition_variable never_;  // a timed wait that nobody cuts short
};

}  // namespace cpslam::program
