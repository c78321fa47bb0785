#include "openni/device_clock.h"

#include <algorithm>
#include <cmath>

namespace cpslam {
namespace {

constexpr double kMicrosecondsPerSecond = 1e6;
/// The camera's clock may lead the host's by as much from one frame to the next: pictures wait on the way.
constexpr std::int64_t kMaxLeadUs = 1'000'000;
/// What lies further apart in a file is no pause but a clock that was set.
constexpr std::int64_t kMaxGapUs = 3'600'000'000;
/// A double tells microseconds apart up to here (285 years); a clock that starts later starts at 0.
constexpr std::uint64_t kMaxStartUs = std::uint64_t{1} << 53U;

double to_s(std::int64_t us) {
  return static_cast<double>(us) / kMicrosecondsPerSecond;
}

}  // namespace

DeviceClock::DeviceClock(bool live, double interval_s)
    : live_(live),
      interval_us_(std::max<std::int64_t>(1, std::llround(interval_s * kMicrosecondsPerSecond))) {}

std::int64_t DeviceClock::expected_us(const CameraFrame& frame) const {
  if (!live_) return interval_us_;
  const auto passed =
      std::chrono::duration_cast<std::chrono::microseconds>(frame.colour.arrived - last_arrived_);
  return std::max<std::int64_t>(interval_us_, passed.count());
}

DeviceClock::Times DeviceClock::read(const CameraFrame& frame) {
  const std::uint64_t stamp_us = frame.colour.time_us;
  Times times;
  if (!started_) {
    now_us_ = stamp_us < kMaxStartUs ? static_cast<std::int64_t>(stamp_us) : 0;
  } else {
    // Differences of unsigned numbers: right whatever the stamps are.
    const auto elapsed_us = static_cast<std::int64_t>(stamp_us - last_us_);
    const std::int64_t expected = expected_us(frame);
    const bool back = elapsed_us <= 0;
    const bool ahead = !back && elapsed_us - expected > kMaxLeadUs;
    const bool bridge = restarted_ || back || (ahead && (live_ || elapsed_us > kMaxGapUs));
    if (!restarted_ && (back || ahead)) times.jump_s = to_s(elapsed_us) - to_s(expected);
    now_us_ += bridge ? expected : elapsed_us;
  }
  started_ = true;
  restarted_ = false;
  last_us_ = stamp_us;
  last_arrived_ = frame.colour.arrived;
  times.time_s = to_s(now_us_);
  times.depth_time_s = to_s(now_us_ + static_cast<std::int64_t>(frame.depth.time_us - stamp_us));
  return times;
}

}  // namespace cpslam
