#include "detect/detector_thread.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "detect/counted_messages.h"
#include "detect/detection_schedule.h"
#include "detect/guarded_detector.h"
#include "util/worker.h"

namespace cpslam {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLongestTimeoutS = 1e6;  // what every clock can count

// Nobody who collects what is due lets so many images wait; keeps one who only offers from filling the
// memory.
constexpr std::size_t kMaxWaiting = 64;

struct Job {
  std::uint64_t frame = 0;
  double time_s = 0.0;
  cv::Mat colour;
};

/// A detection on the schedule whose boxes are to be handed out.
struct Awaited {
  std::uint64_t frame = 0;
  double time_s = 0.0;
  bool finished = false;
  std::optional<Detections> result;  // empty when it failed
};

struct Running {
  double time_s = 0.0;
  Clock::time_point start;
};

struct WakeUp {};  // the jobs themselves lie in the mailbox, where a newer one can replace them

std::string seconds_since(Clock::time_point start) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f",
                std::chrono::duration<double>(Clock::now() - start).count());
  return text.data();
}

DetectionSchedule schedule_of(const DetectorThreadOptions& options) {
  if (options.policy == BoxesPolicy::kWait) return {0.0, 0.0};
  return {options.pretend_rate_hz, options.pretend_delay_s};
}

/// Without a schedule the newest image goes to the detector whenever that is free.
bool is_scheduled(const DetectorThreadOptions& options) {
  return options.sequential || options.policy == BoxesPolicy::kWait || options.pretend_rate_hz > 0.0 ||
         options.pretend_delay_s > 0.0;
}

}  // namespace

class DetectorThread::Impl {
 public:
  Impl(std::unique_ptr<PersonDetector> detector, const DetectorThreadOptions& options, StageTimer& timer,
       const Log& log)
      : detector_(std::move(detector), timer, log),
        scheduled_(is_scheduled(options)),
        timeout_(std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(std::clamp(options.timeout_s, 0.0, kLongestTimeoutS)))),
        log_(log),
        schedule_(schedule_of(options)),
        given_up_(log) {
    if (options.sequential) return;
    worker_.emplace([this](WakeUp&&, const std::stop_token&) { empty_mailbox(); }, 1);
    worker_->start();
  }

  ~Impl() {
    drop_waiting();
    worker_.reset();
  }

  void offer(const Job& job) {
    if (finished_ || (scheduled_ && !schedule_.begins_at(job.time_s))) return;
    if (!worker_) {
      await(job);
      detect(job);
      return;
    }
    if (!put_into_mailbox(job)) return;
    // When there is a wake-up in the queue already, its handling will find this job.
    WakeUp wake_up;
    worker_->try_push(wake_up);
  }

  std::vector<Detections> collect(double time_s) {
    std::unique_lock lock(mutex_);
    if (!scheduled_) give_up_when_overdue();
    std::vector<Detections> result = std::exchange(arrived_, {});
    while (!awaited_.empty() && schedule_.is_due(awaited_.front().time_s, time_s)) {
      if (!wait_for_first(lock)) break;
      if (awaited_.front().result) result.push_back(std::move(*awaited_.front().result));
      awaited_.pop_front();
    }
    return result;
  }

  void finish() {
    finished_ = true;
    drop_waiting();
    std::unique_lock lock(mutex_);
    while (running_ && !stuck_) {
      changed_.wait_until(lock, running_->start + timeout_);
      give_up_when_overdue();
    }
  }

  [[nodiscard]] std::size_t n_detections() const {
    const std::lock_guard lock(mutex_);
    return n_detections_;
  }
  [[nodiscard]] std::size_t n_failures() const {
    const std::lock_guard lock(mutex_);
    return n_failures_;
  }
  [[nodiscard]] bool is_stuck() const {
    const std::lock_guard lock(mutex_);
    return stuck_;
  }

 private:
  /// False when the detector will not see the image.
  bool put_into_mailbox(const Job& job) {
    const std::lock_guard lock(mutex_);
    if (!scheduled_) {
      mailbox_.clear();
    } else if (stuck_ || mailbox_.size() >= kMaxWaiting) {
      ++n_skipped_;
      return false;
    } else {
      awaited_.push_back({job.frame, job.time_s, false, {}});
    }
    mailbox_.push_back(job);
    return true;
  }

  void await(const Job& job) {
    const std::lock_guard lock(mutex_);
    awaited_.push_back({job.frame, job.time_s, false, {}});
  }

  void drop_waiting() {
    const std::lock_guard lock(mutex_);
    mailbox_.clear();
    awaited_.clear();
  }

  /// In the worker's thread.
  void empty_mailbox() {
    while (const std::optional<Job> job = take_job()) detect(*job);
  }

  std::optional<Job> take_job() {
    const std::lock_guard lock(mutex_);
    if (mailbox_.empty()) return std::nullopt;
    Job job = std::move(mailbox_.front());
    mailbox_.pop_front();
    running_ = Running{job.time_s, Clock::now()};
    changed_.notify_all();
    return job;
  }

  /// In the worker's thread, or the caller's when there is none.
  void detect(const Job& job) {
    std::optional<std::vector<PersonBox>> boxes = detector_.detect(job.colour, job.time_s);
    std::optional<Detections> result;
    if (boxes) result = Detections{job.frame, job.time_s, std::move(*boxes)};
    hand_back(job.frame, std::move(result));
  }

  void hand_back(std::uint64_t frame, std::optional<Detections> result) {
    const std::lock_guard lock(mutex_);
    if (stuck_) {
      report_return();
    } else {
      ++n_detections_;
      if (!result) ++n_failures_;
    }
    running_.reset();
    stuck_ = false;
    const auto awaited = std::find_if(awaited_.begin(), awaited_.end(),
                                      [&](const Awaited& other) { return other.frame == frame; });
    if (awaited != awaited_.end()) {
      awaited->finished = true;
      awaited->result = std::move(result);
    } else if (result) {
      arrived_.push_back(std::move(*result));
    }
    changed_.notify_all();
  }

  /// False when its detection, or the one before it, was given up.
  bool wait_for_first(std::unique_lock<std::mutex>& lock) {
    while (!awaited_.front().finished) {
      changed_.wait_until(lock, (running_ ? running_->start : Clock::now()) + timeout_);
      if (!awaited_.front().finished && give_up_when_overdue()) return false;
    }
    return true;
  }

  /// With the lock held. Leaves nothing that anybody would wait for, when it gives up.
  bool give_up_when_overdue() {
    if (!running_ || stuck_ || Clock::now() - running_->start < timeout_) return false;
    stuck_ = true;
    ++n_detections_;
    ++n_failures_;
    n_skipped_ = 0;
    if (scheduled_) {
      n_skipped_ = mailbox_.size();
      mailbox_.clear();
      awaited_.clear();
    }
    given_up_.error("the person detector (" + detector_.name() + ") is given up after " +
                    seconds_since(running_->start) + " s on the frame of " +
                    std::to_string(running_->time_s) +
                    "; tracking goes on without new boxes until it comes back");
    return true;
  }

  /// With the lock held.
  void report_return() {
    std::string message = "the person detector is back after " + seconds_since(running_->start) + " s";
    if (scheduled_) message += "; " + std::to_string(n_skipped_) + " images were not shown to it";
    log_.warning(message);
  }

  GuardedDetector detector_;  // in the thread that detects
  const bool scheduled_;
  const Clock::duration timeout_;
  const Log log_;
  DetectionSchedule schedule_;  // this and the next in the caller's thread only
  bool finished_ = false;

  mutable std::mutex mutex_;  // guards what follows, but for the worker; no other lock is taken under it but
                              // the log's
  std::condition_variable changed_;
  CountedMessages given_up_;
  std::deque<Job> mailbox_;          // not yet begun
  std::deque<Awaited> awaited_;      // on the schedule, not yet handed out
  std::vector<Detections> arrived_;  // without a schedule, or late
  std::optional<Running> running_;   // in the worker's thread
  bool stuck_ = false;               // running_ was given up
  std::size_t n_detections_ = 0;
  std::size_t n_failures_ = 0;
  std::size_t n_skipped_ = 0;  // images since it got stuck

  std::optional<Worker<WakeUp>> worker_;  // last: ends before what it uses
};

DetectorThread::DetectorThread(std::unique_ptr<PersonDetector> detector, const DetectorThreadOptions& options,
                               StageTimer& timer, const Log& log)
    : impl_(std::make_unique<Impl>(std::move(detector), options, timer, log)) {}
DetectorThread::~DetectorThread() = default;
void DetectorThread::offer(std::uint64_t frame, double time_s, const cv::Mat& colour) {
  impl_->offer({frame, time_s, colour});
}
std::vector<Detections> DetectorThread::collect(double time_s) {
  return impl_->collect(time_s);
}
void DetectorThread::finish() {
  impl_->finish();
}
std::size_t DetectorThread::n_detections() const {
  return impl_->n_detections();
}
std::size_t DetectorThread::n_failures() const {
  return impl_->n_failures();
}
bool DetectorThread::is_stuck() const {
  return impl_->is_stuck();
}

}  // namespace cpslam
