#include "virtual_camera/player.h"

#include <utility>

namespace cpslam::virtual_camera {

Player::Player(CameraScript script, std::function<void(bool)> plugged)
    : script_(std::move(script)),
      plugged_callback_(std::move(plugged)),
      film_(script_),
      worker_([this](int&&, const std::stop_token& stop) { play(stop); }, 1) {
  worker_.push(0);
  worker_.start();
}

bool Player::plugged() const {
  const std::lock_guard lock(mutex_);
  return plugged_;
}

void Player::set_colour_sink(PictureSink* sink) {
  set(colour_, sink);
}

void Player::set_depth_sink(PictureSink* sink) {
  set(depth_, sink);
}

void Player::open() {
  const std::lock_guard lock(mutex_);
  stalled_ = script_.die_after && static_cast<int>(n_played_) >= *script_.die_after;
  time_us_ = script_.start_us;
}

void Player::set(PictureSink*& slot, PictureSink* sink) {
  const std::lock_guard lock(mutex_);
  if (colour_ == nullptr && depth_ == nullptr) due_ = Clock::now();
  slot = sink;
  changed_.notify_all();
}

void Player::play(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    const auto listened = [this] { return !stalled_ && (colour_ != nullptr || depth_ != nullptr); };
    if (!changed_.wait(lock, stop, listened)) return;
    play_next(lock, stop);
  }
}

void Player::play_next(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  const auto left = [this] { return colour_ == nullptr && depth_ == nullptr; };
  if (changed_.wait_until(lock, stop, due_, left) || stop.stop_requested()) return;
  const Film::Step step = film_.step(n_played_++);
  deliver(step);
  time_us_ += step.interval_us;
  due_ += std::chrono::microseconds(step.interval_us);
  const int played = static_cast<int>(n_played_);
  if (played == script_.stall_after || played == script_.die_after) stalled_ = true;
  if (played == script_.unplug_after) be_unplugged(lock, stop);
}

void Player::be_unplugged(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  plugged_ = false;
  lock.unlock();
  plugged_callback_(false);
  lock.lock();
  const auto never = [] { return false; };
  if (!script_.return_after) {
    changed_.wait(lock, stop, never);
    return;
  }
  const auto back = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(*script_.return_after));
  changed_.wait_until(lock, stop, back, never);
  if (stop.stop_requested()) return;
  plugged_ = true;
  due_ = Clock::now();
  lock.unlock();
  plugged_callback_(true);
  lock.lock();
}

void Player::deliver(const Film::Step& step) {
  const int index = static_cast<int>(n_played_);
  const bool jumped = script_.jump_after && index > *script_.jump_after;
  const std::int64_t time_us = static_cast<std::int64_t>(time_us_) + (jumped ? script_.jump_us : 0);
  if (depth_ != nullptr) {
    depth_->deliver(step.picture.depth_mm, static_cast<std::uint64_t>(time_us + step.depth_delay_us), index);
  }
  if (colour_ != nullptr) colour_->deliver(step.picture.rgb, static_cast<std::uint64_t>(time_us), index);
}

}  // namespace cpslam::virtual_camera
