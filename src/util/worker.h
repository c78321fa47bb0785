#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <stdexcept>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace cpslam {

enum class OnStop {
  kDrop,   ///< ask the handler to hurry through its stop token and drop what is queued
  kDrain,  ///< handle what is queued first
};

/// A thread that handles the items of a bounded queue one after the other: the only kind of thread in the
/// project. Built with its handler, wired, then start()ed.
///
/// An exception that leaves the handler ends the thread and drops the queue; push(), try_push(), wait_idle()
/// and rethrow_if_failed() throw it again in their caller's thread. All members are thread-safe. Never call a
/// waiting member (push, wait_*, stop) from the handler, nor wait there for a future of its own worker. Items
/// that are dropped die under the worker's lock, so their destructors must not call the worker.
template <typename Item>
class Worker {
 public:
  /// Called in the worker's thread without a lock held. The token is set by stop(OnStop::kDrop).
  using Handler = std::function<void(Item&&, const std::stop_token&)>;

  /// Throws std::invalid_argument for an empty handler or a capacity of 0.
  Worker(Handler handler, std::size_t capacity) : handler_(std::move(handler)), capacity_(capacity) {
    if (!handler_ || capacity_ == 0) throw std::invalid_argument("Worker: needs a handler and a capacity");
  }
  ~Worker() { stop(OnStop::kDrop); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Once in a life: throws std::logic_error when it was started or stopped before.
  void start() {
    const std::lock_guard lock(mutex_);
    if (running_ || closed_) throw std::logic_error("Worker: can be started only once");
    thread_ = std::jthread([this] { run(); });
    running_ = true;
  }

  /// Waits while the queue is full (also before start()). False, and the item is dropped, when stopped.
  bool push(Item item) {
    std::unique_lock lock(mutex_);
    progress_.wait(lock, [this] { return closed_ || queue_.size() < capacity_; });
    return enqueue(item);
  }

  /// Never waits. False when the queue is full or the worker stopped: then the item is left as it was.
  bool try_push(Item& item) {
    const std::lock_guard lock(mutex_);
    return enqueue(item);
  }

  /// The future is ready as soon as the thread is between two items; it then handles no further item until
  /// resume(). Items may still be queued. A failed worker delivers its exception through the future.
  [[nodiscard]] std::future<void> pause() {
    const std::lock_guard lock(mutex_);
    paused_ = true;
    return request();
  }

  void resume() {
    const std::lock_guard lock(mutex_);
    paused_ = false;
    work_.notify_one();
  }

  /// Drops, once the thread is between two items, all that is queued then; the future is ready afterwards.
  /// Goes with a pause() or without. A failed worker delivers its exception through the future.
  [[nodiscard]] std::future<void> reset() {
    const std::lock_guard lock(mutex_);
    drop_queue_ = true;
    return request();
  }

  /// Waits until fewer than `limit` items (limit > 0) are queued or in progress, or the worker has stopped;
  /// throws what the handler threw. A paused worker makes no progress.
  void wait_load_below(std::size_t limit) {
    std::unique_lock lock(mutex_);
    progress_.wait(lock, [this, limit] { return load_locked() < limit || (closed_ && !running_); });
    if (failure_) std::rethrow_exception(failure_);
  }

  /// Waits until nothing is queued or in progress, or the worker has stopped; throws what the handler threw.
  void wait_idle() { wait_load_below(1); }

  /// Accepts no more items, ends and joins the thread, paused or not. Idempotent; any thread may call it,
  /// even while another one is in it: a kDrop cuts a kDrain short. Does not throw what the handler threw.
  void stop(OnStop how = OnStop::kDrop) {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
      paused_ = false;
      if (how == OnStop::kDrop) stop_.request_stop();
      if (!running_) settle();
      work_.notify_one();
      progress_.notify_all();
    }
    const std::lock_guard join_lock(join_mutex_);
    if (thread_.joinable()) thread_.join();
  }

  void rethrow_if_failed() const {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
  }

  /// Items queued or in progress.
  [[nodiscard]] std::size_t load() const {
    const std::lock_guard lock(mutex_);
    return load_locked();
  }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }

 private:
  [[nodiscard]] std::size_t load_locked() const { return queue_.size() + (busy_ ? 1U : 0U); }

  bool enqueue(Item& item) {
    if (failure_) std::rethrow_exception(failure_);
    if (closed_ || queue_.size() >= capacity_) return false;
    queue_.push_back(std::move(item));
    work_.notify_one();
    return true;
  }

  /// A future that the thread, or we ourselves when there is none, makes ready in settle().
  std::future<void> request() {
    std::future<void> ready = requests_.emplace_back().get_future();
    if (!running_) settle();
    work_.notify_one();
    return ready;
  }

  /// Carries out what was asked for while no item is in progress.
  void settle() {
    if (drop_queue_ || (closed_ && !running_)) queue_.clear();
    drop_queue_ = false;
    for (std::promise<void>& request : requests_) {
      if (failure_) {
        request.set_exception(failure_);
      } else {
        request.set_value();
      }
    }
    requests_.clear();
    progress_.notify_all();
  }

  /// True when there is an item to handle, false when the thread should end.
  bool wait_for_work(std::unique_lock<std::mutex>& lock) {
    while (true) {
      settle();
      if (stop_.stop_requested()) return false;
      if (!queue_.empty() && (!paused_ || closed_)) return true;
      if (closed_) return false;
      work_.wait(lock, [this] { return closed_ || !requests_.empty() || (!queue_.empty() && !paused_); });
    }
  }

  void handle_next(std::unique_lock<std::mutex>& lock) {
    std::exception_ptr failure;
    {
      Item item = std::move(queue_.front());
      queue_.pop_front();
      busy_ = true;
      progress_.notify_all();
      lock.unlock();
      try {
        handler_(std::move(item), stop_.get_token());
      } catch (...) {
        failure = std::current_exception();
      }
    }  // the item dies before the worker counts as idle
    lock.lock();
    busy_ = false;
    failure_ = failure;
  }

  void run() {
    std::unique_lock lock(mutex_);
    while (!failure_ && wait_for_work(lock)) handle_next(lock);
    closed_ = true;
    running_ = false;
    settle();
  }

  const Handler handler_;
  const std::size_t capacity_;

  mutable std::mutex mutex_;          // guards all below but thread_
  std::condition_variable work_;      // the thread waits here
  std::condition_variable progress_;  // callers wait here
  std::deque<Item> queue_;
  std::vector<std::promise<void>> requests_;
  std::exception_ptr failure_;
  bool drop_queue_ = false;
  bool paused_ = false;
  bool busy_ = false;
  bool running_ = false;
  bool closed_ = false;
  std::stop_source stop_;

  std::mutex join_mutex_;  // guards thread_ once it runs; never taken with mutex_ held
  std::jthread thread_;
};

}  // namespace cpslam
