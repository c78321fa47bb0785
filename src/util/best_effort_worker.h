#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "util/log.h"
#include "util/worker.h"

namespace cpslam {

/// What becomes of an item when too many are waiting.
enum class WhenBusy { kWait, kLeaveOut };

/// A Worker for what a run can do without, such as pictures of it: what its handler throws is warned of once,
/// and no more items are taken. add() and finish() from one thread.
template <typename Item>
class BestEffortWorker {
 public:
  /// consequence: what the warning says after the reason. Throws std::invalid_argument as Worker does.
  BestEffortWorker(std::function<void(const Item&)> handler, std::size_t capacity, WhenBusy when_busy,
                   LogSink log, std::string consequence)
      : when_busy_(when_busy),
        log_(std::move(log)),
        consequence_(std::move(consequence)),
        worker_([handle = std::move(handler)](Item&& item, const std::stop_token&) { handle(item); },
                capacity) {}

  /// Once in a life.
  void start() { worker_.start(); }

  void add(Item item) {
    if (failed_) return;
    try {
      if (when_busy_ == WhenBusy::kWait) {
        worker_.push(std::move(item));
      } else if (!worker_.try_push(item)) {
        ++left_out_;
      }
    } catch (const std::exception& error) {
      give_up(error.what());
    }
  }

  /// Handles what is waiting and ends the thread.
  void finish() {
    worker_.stop(OnStop::kDrain);
    if (failed_) return;
    try {
      worker_.rethrow_if_failed();
    } catch (const std::exception& error) {
      give_up(error.what());
    }
  }

  /// Items not handled, because too many were waiting.
  [[nodiscard]] std::size_t left_out() const { return left_out_; }
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  void give_up(const std::string& reason) {
    failed_ = true;
    log_.warning(reason + "; " + consequence_);
  }

  const WhenBusy when_busy_;
  const Log log_;
  const std::string consequence_;
  std::size_t left_out_ = 0;
  bool failed_ = false;
  Worker<Item> worker_;
};

}  // namespace cpslam
