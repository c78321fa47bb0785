#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "cpslam/types.h"

namespace cpslam {

/// Durations counted in logarithmic buckets of 1 % width: about 9 kB however long the run, and percentiles
/// right to 0.5 % from 0.1 us to 10^5 s (what lies outside counts as the nearest end). Maximum, minimum
/// and sum are exact.
class DurationHistogram {
 public:
  /// Negative durations and NaN count as 0.
  void add(double duration_ms);
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double max_ms() const { return max_ms_; }
  [[nodiscard]] double total_ms() const { return total_ms_; }
  /// Nearest-rank percentile: the smallest duration that at least `fraction` (0 to 1) of all do not exceed. 0
  /// without durations.
  [[nodiscard]] double percentile_ms(double fraction) const;

 private:
  std::vector<std::uint32_t> buckets_;
  std::size_t count_ = 0;
  double min_ms_ = 0.0;
  double max_ms_ = 0.0;
  double total_ms_ = 0.0;
};

/// Collects how long the stages of the system take. Thread-safe; must outlive its scopes.
class StageTimer {
 public:
  /// Measures from its creation to the end of its life.
  class Scope {
   public:
    Scope(StageTimer& timer, std::size_t stage);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    StageTimer& timer_;
    std::size_t stage_;
    std::chrono::steady_clock::time_point start_;
  };

  /// `const StageTimer::Scope scope = timer.time("extract");`
  [[nodiscard]] Scope time(std::string_view stage) { return {*this, index_of(stage)}; }

  /// Adds a duration measured elsewhere.
  void add(std::string_view stage, double duration_ms) { add(index_of(stage), duration_ms); }

  /// All stages with at least one finished duration, in the order in which they were first begun.
  [[nodiscard]] std::vector<StageTimes> summary() const;

 private:
  struct Stage {
    std::string name;
    DurationHistogram durations;
  };
  std::size_t index_of(std::string_view stage);
  void add(std::size_t stage, double duration_ms);

  mutable std::mutex mutex_;
  std::vector<Stage> stages_;
};

}  // namespace cpslam
