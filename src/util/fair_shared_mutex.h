#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>

namespace cpslam {

/// A shared mutex that starves nobody: once a writer waits no further reader comes in, and when a writer is
/// done the readers that waited for it go before the next writer. glibc's own lets readers that overlap each
/// other keep a writer out for ever. For std::unique_lock and std::shared_lock. A thread that holds it,
/// shared or not, must not ask for it again.
class FairSharedMutex {
 public:
  FairSharedMutex() = default;
  FairSharedMutex(const FairSharedMutex&) = delete;
  FairSharedMutex& operator=(const FairSharedMutex&) = delete;

  void lock() {
    std::unique_lock guard(guard_);
    ++writers_waiting_;
    writers_turn_.wait(guard, [this] { return !writing_ && readers_ == 0; });
    --writers_waiting_;
    writing_ = true;
  }

  void unlock() {
    const std::lock_guard guard(guard_);
    writing_ = false;
    if (readers_waiting_ > 0) {
      // They count as in from here on, so that no writer slips in before they wake up.
      readers_ = readers_waiting_;
      readers_waiting_ = 0;
      ++batch_;
      readers_turn_.notify_all();
    } else {
      writers_turn_.notify_one();
    }
  }

  void lock_shared() {
    std::unique_lock guard(guard_);
    if (!writing_ && writers_waiting_ == 0) {
      ++readers_;
      return;
    }
    ++readers_waiting_;
    readers_turn_.wait(guard, [this, mine = batch_] { return batch_ != mine; });
  }

  void unlock_shared() {
    const std::lock_guard guard(guard_);
    if (--readers_ == 0) writers_turn_.notify_one();
  }

 private:
  std::mutex guard_;  // held for moments only; guards all below
  std::condition_variable writers_turn_;
  std::condition_variable readers_turn_;
  std::size_t readers_ = 0;  // that hold it
  std::size_t readers_waiting_ = 0;
  std::size_t writers_waiting_ = 0;
  std::uint64_t batch_ = 0;  // grows when waiting readers are let in
  bool writing_ = false;
};

}  // namespace cpslam
