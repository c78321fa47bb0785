#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <stop_token>
#include <utility>

namespace cpslam {

/// What is to be done to the map before the next frame.
struct MapWishes {
  bool reset = false;
  std::optional<bool> localization;  ///< after the reset; to be switched on or off
};

/// How somebody at the screen steers a run: pause, single steps, the end, and what is done to the map. The
/// run asks for its turn and for the wishes before each frame. Thread-safe.
class RunControl {
 public:
  void pause() {
    const std::lock_guard lock(mutex_);
    paused_ = true;
  }
  void resume() {
    const std::lock_guard lock(mutex_);
    paused_ = false;
    steps_ = 0;
    changed_.notify_all();
  }
  /// One more frame, then pause.
  void step() {
    const std::lock_guard lock(mutex_);
    paused_ = true;
    ++steps_;
    changed_.notify_all();
  }
  /// No more frames, paused or not.
  void quit() {
    quitting_.request_stop();  // not with the lock: it calls back
    const std::lock_guard lock(mutex_);
    changed_.notify_all();
  }

  void wish_reset() {
    const std::lock_guard lock(mutex_);
    wishes_.reset = true;
  }
  void wish_localization(bool on) {
    const std::lock_guard lock(mutex_);
    wishes_.localization = on;
  }
  /// Those of now: they count as fulfilled.
  [[nodiscard]] MapWishes take_wishes() {
    const std::lock_guard lock(mutex_);
    return std::exchange(wishes_, {});
  }
  /// Those not taken yet.
  [[nodiscard]] MapWishes wishes() const {
    const std::lock_guard lock(mutex_);
    return wishes_;
  }

  [[nodiscard]] bool paused() const {
    const std::lock_guard lock(mutex_);
    return paused_;
  }
  [[nodiscard]] bool quitting() const { return quitting_.stop_requested(); }
  /// Stopped by quit(); for runs that wait for something else.
  [[nodiscard]] std::stop_token token() const { return quitting_.get_token(); }

  /// Waits until the next frame may be taken: how long that was. Nothing: no more frames.
  [[nodiscard]] std::optional<std::chrono::steady_clock::duration> wait_for_turn() {
    const auto start = std::chrono::steady_clock::now();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return quitting() || !paused_ || steps_ > 0; });
    if (quitting()) return std::nullopt;
    if (paused_) --steps_;
    return std::chrono::steady_clock::now() - start;
  }

 private:
  std::stop_source quitting_;
  mutable std::mutex mutex_;  // guards all below
  std::condition_variable changed_;
  bool paused_ = false;
  std::size_t steps_ = 0;  // asked for and not yet taken
  MapWishes wishes_;
};

}  // namespace cpslam
