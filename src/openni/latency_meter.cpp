#include "openni/latency_meter.h"

#include <algorithm>

namespace cpslam {
namespace {

/// Two quartz clocks drift apart by less.
constexpr double kDrift = 1e-4;

double seconds(LatencyMeter::HostTime time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

}  // namespace

double LatencyMeter::add(double time_s, HostTime arrived, HostTime now) {
  const double delay_s = seconds(arrived) - time_s;
  if (least_delay_s_) {
    least_delay_s_ = std::min(*least_delay_s_ + kDrift * (time_s - last_time_s_), delay_s);
  } else {
    least_delay_s_ = delay_s;
  }
  last_time_s_ = time_s;
  return 1e3 * (seconds(now) - time_s - *least_delay_s_);
}

}  // namespace cpslam
