#include "detect/detection_schedule.h"

#include <algorithm>

namespace cpslam {
namespace {

constexpr double kJitterS = 0.005;       // of recorded cameras' stamps
constexpr double kJitterOfPeriod = 0.1;  // and never more of a period than this
constexpr double kRoundingS = 1e-4;      // of stamps written with six decimals, a few of them added up

}  // namespace

DetectionSchedule::DetectionSchedule(double rate_hz, double delay_s)
    : period_s_(rate_hz > 0.0 ? 1.0 / rate_hz : 0.0), delay_s_(std::max(delay_s, 0.0)) {}

bool DetectionSchedule::begins_at(double time_s) {
  const double tolerance_s = std::min(kJitterS, kJitterOfPeriod * period_s_);
  if (next_s_ && time_s < *next_s_ - tolerance_s) return false;
  // After a gap a detector has no turns to make up for.
  const bool on_the_grid = next_s_ && time_s < *next_s_ + period_s_;
  next_s_ = (on_the_grid ? *next_s_ : time_s) + period_s_;
  return true;
}

bool DetectionSchedule::is_due(double begin_s, double now_s) const {
  return now_s - begin_s >= delay_s_ - kRoundingS;
}

}  // namespace cpslam
