#include "viewer/timing_history.h"

#include <algorithm>

namespace cpslam::viewer {
namespace {

enum Part : std::size_t { kFeatures, kPeople, kDetector, kPose };

TimingParts totals_of(const std::vector<StageTimes>& stages) {
  TimingParts totals{};
  double all_ms = 0.0;
  for (const StageTimes& stage : stages) {
    if (stage.stage == "track") {
      all_ms = stage.total_ms;
    } else if (stage.stage == "track: features") {
      totals[kFeatures] += stage.total_ms;
    } else if (stage.stage == "track: wait for boxes") {
      totals[kDetector] += stage.total_ms;
    } else if (stage.stage.starts_with("people: ")) {
      totals[kPeople] += stage.total_ms;
    }
  }
  totals[kPose] = std::max(0.0, all_ms - totals[kFeatures] - totals[kPeople] - totals[kDetector]);
  return totals;
}

}  // namespace

void TimingHistory::add(const FrameSnapshot& frame) {
  stages_ = frame.stages;
  const std::uint64_t n_frames = frame.index + 1;
  if (n_frames < n_frames_) *this = TimingHistory();
  if (n_frames == n_frames_) return;
  const TimingParts totals = totals_of(frame.stages);
  TimingParts mean{};
  for (std::size_t i = 0; i < mean.size(); ++i)
    mean[i] = std::max(0.0, totals[i] - totals_[i]) / static_cast<double>(n_frames - n_frames_);
  frames_.push_back(mean);
  if (frames_.size() > kLength) frames_.pop_front();
  totals_ = totals;
  n_frames_ = n_frames;
}

}  // namespace cpslam::viewer
