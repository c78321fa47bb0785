#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cpslam/person_detector.h"
#include "util/log.h"

namespace cpslam {

/// Calls a function in the place of a detector.
class FunctionDetector : public PersonDetector {
 public:
  using Function = std::function<std::vector<PersonBox>(double time_s)>;
  explicit FunctionDetector(Function function) : function_(std::move(function)) {}
  std::vector<PersonBox> detect(const cv::Mat& /*colour*/, double time_s) override {
    return function_(time_s);
  }
  [[nodiscard]] std::string name() const override { return "the test's own"; }

 private:
  Function function_;
};

inline std::unique_ptr<PersonDetector> detector_that(FunctionDetector::Function function) {
  return std::make_unique<FunctionDetector>(std::move(function));
}

/// One box that says which image it was found in.
inline std::vector<PersonBox> box_of(double time_s) {
  return {{time_s, 0.0, 10.0, 20.0, 0.5}};
}

/// Holds a detector until the test opens it, and tells the test how many have come.
class Gate {
 public:
  void pass() {
    std::unique_lock lock(mutex_);
    ++arrived_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_; });
  }
  void wait_for(int n) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this, n] { return arrived_ >= n; });
  }
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }
  [[nodiscard]] int arrived() {
    const std::lock_guard lock(mutex_);
    return arrived_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int arrived_ = 0;
  bool open_ = false;
};

/// Waits for what another thread is about to do; false when it does not within half a minute.
inline bool eventually(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::yield();
  }
  return true;
}

/// Keeps what is logged.
class LogBook {
 public:
  [[nodiscard]] LogSink sink() {
    return [this](LogLevel level, const std::string& message) {
      const std::lock_guard lock(mutex_);
      lines_.emplace_back(level, message);
    };
  }
  [[nodiscard]] Log log() { return Log(sink()); }
  [[nodiscard]] std::vector<std::string> at(LogLevel level) {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> messages;
    for (const auto& [line_level, message] : lines_) {
      if (line_level == level) messages.push_back(message);
    }
    return messages;
  }

 private:
  std::mutex mutex_;
  std::vector<std::pair<LogLevel, std::string>> lines_;
};

}  // namespace cpslam
