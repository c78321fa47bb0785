#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace cpslam::program {

/// "tracking [=====>    ]  50 %  125/250  28.3/s  eta 0:04" on stderr: redrawn in place on a terminal, a line
/// every tenth elsewhere, nothing when disabled. Where nobody knows how much there is (total 0) "tracking 125
/// 28.3/s", on a terminal only. Thread-safe.
class ProgressBar {
 public:
  ProgressBar(std::string label, std::size_t total, bool enabled);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(std::size_t done, const std::string& note = {});
  /// Writes a line above the bar.
  void print_line(const std::string& line);
  /// Ends the bar's line; later updates draw nothing.
  void finish();

 private:
  void draw();
  [[nodiscard]] std::string text() const;

  std::mutex mutex_;
  const std::string label_;
  const std::size_t total_;
  bool enabled_;
  const bool terminal_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point drawn_;
  std::size_t done_ = 0;
  std::size_t last_tenth_ = 0;
  std::string note_;
};

}  // namespace cpslam::program
