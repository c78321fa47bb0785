#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string_view>
#include <vector>

#include "cpslam/snapshot.h"

namespace cpslam::viewer {

/// Where the time of a frame goes, in parts that do not overlap.
inline constexpr std::array<std::string_view, 4> kTimingParts{"features", "people", "detector", "pose"};
using TimingParts = std::array<double, kTimingParts.size()>;  ///< ms

/// The time that tracking took, frame by frame: from the sums that snapshots carry. When frames were left out
/// between two snapshots, the mean of all frames since the last.
class TimingHistory {
 public:
  void add(const FrameSnapshot& frame);
  /// Oldest first, the last kLength.
  [[nodiscard]] const std::deque<TimingParts>& frames() const { return frames_; }
  /// Percentiles over the whole run, by stage.
  [[nodiscard]] const std::vector<StageTimes>& stages() const { return stages_; }

  static constexpr std::size_t kLength = 150;

 private:
  std::uint64_t n_frames_ = 0;  // up to the last snapshot
  TimingParts totals_{};        // likewise
  std::deque<TimingParts> frames_;
  std::vector<StageTimes> stages_;
};

}  // namespace cpslam::viewer
