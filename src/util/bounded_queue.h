#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <utility>

namespace cpslam {

/// First-in-first-out queue between threads that holds at most `capacity` items. A full queue blocks the
/// pusher, an empty one the popper. After close() nothing more goes in, but pop() still delivers what is
/// queued: close, drain, then join. All members are thread-safe; T needs to be movable only.
template <typename T>
class BoundedQueue {
 public:
  /// Throws std::invalid_argument for a capacity of 0.
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {
    if (capacity == 0) throw std::invalid_argument("BoundedQueue: the capacity must be at least 1");
  }
  BoundedQueue(const BoundedQueue&) = delete;
  BoundedQueue& operator=(const BoundedQueue&) = delete;

  /// Waits while the queue is full. False, and the item is dropped, when the queue is closed or a stop is
  /// requested before there is room.
  bool push(T item, const std::stop_token& stop = {}) {
    std::unique_lock lock(mutex_);
    const bool ready = changed_.wait(lock, stop, [this] { return closed_ || items_.size() < capacity_; });
    if (!ready || closed_) return false;
    items_.push_back(std::move(item));
    changed_.notify_all();
    return true;
  }

  /// Never waits. False when the queue is full or closed: then the item is left as it was.
  bool try_push(T& item) {
    const std::lock_guard lock(mutex_);
    if (closed_ || items_.size() >= capacity_) return false;
    items_.push_back(std::move(item));
    changed_.notify_all();
    return true;
  }

  /// Waits while the queue is empty. Nothing when it is closed and drained, or when it is empty and a stop is
  /// requested.
  std::optional<T> pop(const std::stop_token& stop = {}) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, stop, [this] { return closed_ || !items_.empty(); });
    if (items_.empty()) return std::nullopt;
    std::optional<T> item(std::move(items_.front()));
    items_.pop_front();
    changed_.notify_all();
    return item;
  }

  /// Waits until fewer than `limit` items (limit > 0) are queued; false when a stop is requested or the queue
  /// is closed with as many or more items in it.
  bool wait_until_below(std::size_t limit, const std::stop_token& stop = {}) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, stop, [this, limit] { return closed_ || items_.size() < limit; });
    return items_.size() < limit;
  }

  /// Wakes everybody who waits. Idempotent.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

  [[nodiscard]] bool closed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
  }
  [[nodiscard]] std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return items_.size();
  }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<T> items_;
  bool closed_ = false;
};

}  // namespace cpslam
