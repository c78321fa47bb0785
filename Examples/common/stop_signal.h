#pragma once

#include <stop_token>

#include "util/worker.h"

namespace cpslam::program {

/// Makes Ctrl-C (SIGINT) and SIGTERM set a flag instead of ending the program, so that what was tracked is
/// saved; a second Ctrl-C ends it at once.
void install_stop_signal();

[[nodiscard]] bool stop_requested();

/// install_stop_signal() for who waits: its token is stopped as soon as the signal comes. One at a time.
class StopSignal {
 public:
  /// Throws RunError when the process has no more file descriptors.
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

 private:
  void wait_for_wake();

  std::stop_source source_;
  int wake_ = -1;        // an eventfd, which is all that a signal handler can reach
  Worker<int> watcher_;  // waits for it
};

}  // namespace cpslam::program
