#include "util/stage_timer.h"

#include <algorithm>
#include <cmath>

namespace cpslam {
namespace {

constexpr double kSmallestMs = 1e-4;
constexpr double kLargestMs = 1e8;
constexpr double kBucketsPerUnit = 100.0;  // per factor e: buckets of 1 % width

std::size_t bucket_of(double duration_ms) {
  const double clamped = std::clamp(duration_ms, kSmallestMs, kLargestMs);
  return static_cast<std::size_t>(std::log(clamped / kSmallestMs) * kBucketsPerUnit);
}

double centre_ms(std::size_t bucket) {
  return kSmallestMs * std::exp((static_cast<double>(bucket) + 0.5) / kBucketsPerUnit);
}

}  // namespace

void DurationHistogram::add(double duration_ms) {
  if (!(duration_ms > 0.0)) duration_ms = 0.0;
  const std::size_t bucket = bucket_of(duration_ms);
  if (buckets_.empty()) buckets_.resize(bucket_of(kLargestMs) + 1);
  ++buckets_[bucket];
  min_ms_ = count_ == 0 ? duration_ms : std::min(min_ms_, duration_ms);
  max_ms_ = std::max(max_ms_, duration_ms);
  total_ms_ += duration_ms;
  ++count_;
}

double DurationHistogram::percentile_ms(double fraction) const {
  if (count_ == 0) return 0.0;
  const double rank = std::ceil(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(count_));
  std::size_t below = 0;
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    below += buckets_[i];
    if (below > 0 && static_cast<double>(below) >= rank) return std::clamp(centre_ms(i), min_ms_, max_ms_);
  }
  return max_ms_;
}

StageTimer::Scope::Scope(StageTimer& timer, std::size_t stage)
    : timer_(timer), stage_(stage), start_(std::chrono::steady_clock::now()) {}

StageTimer::Scope::~Scope() {
  const std::chrono::duration<double, std::milli> duration = std::chrono::steady_clock::now() - start_;
  timer_.add(stage_, duration.count());
}

std::size_t StageTimer::index_of(std::string_view stage) {
  const std::lock_guard lock(mutex_);
  // A dozen stages: a linear search is faster than any map.
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    if (stages_[i].name == stage) return i;
  }
  stages_.push_back({std::string(stage), {}});
  return stages_.size() - 1;
}

void StageTimer::add(std::size_t stage, double duration_ms) {
  const std::lock_guard lock(mutex_);
  stages_[stage].durations.add(duration_ms);
}

std::vector<StageTimes> StageTimer::summary() const {
  const std::lock_guard lock(mutex_);
  std::vector<StageTimes> times;
  for (const Stage& stage : stages_) {
    const DurationHistogram& d = stage.durations;
    if (d.count() == 0) continue;
    times.push_back(
        {stage.name, d.count(), d.percentile_ms(0.5), d.percentile_ms(0.95), d.max_ms(), d.total_ms()});
  }
  return times;
}

}  // namespace cpslam
