#include "slam/new_map_decision.h"

#include <algorithm>

namespace cpslam {
namespace {

// So long the camera may show too little, or nothing come, and it is still the same look at the same place.
constexpr double kLongestGapS = 0.5;
// A map of fewer keyframes was lost at once.
constexpr int kFirmKeyframes = 5;
constexpr double kLongestWait = 16.0;  // times the usual one

}  // namespace

bool NewMapDecision::is_due(double time_s, bool could_begin) {
  const double passed_s = time_s - last_time_s_.value_or(time_s);
  last_time_s_ = time_s;
  if (after_s_ <= 0.0) return false;
  if (!could_begin) {
    covered_s_ += passed_s;
    if (covered_s_ > kLongestGapS) looked_s_ = 0.0;
    return false;
  }
  covered_s_ = 0.0;
  looked_s_ += std::min(passed_s, kLongestGapS);
  return looked_s_ >= present_wait_s();
}

double NewMapDecision::present_wait_s() const {
  const bool lost_at_once = keyframes_ && *keyframes_ < kFirmKeyframes;
  return lost_at_once ? std::min(2.0 * last_wait_s_, kLongestWait * after_s_) : after_s_;
}

void NewMapDecision::found(double time_s, bool keyframe) {
  last_time_s_ = time_s;
  looked_s_ = 0.0;
  covered_s_ = 0.0;
  if (keyframe && keyframes_) ++*keyframes_;
}

void NewMapDecision::begun() {
  last_wait_s_ = present_wait_s();
  keyframes_ = 0;
}

}  // namespace cpslam
