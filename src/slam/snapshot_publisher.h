#pragma once

#include <functional>
#include <memory>

#include "cpslam/snapshot.h"
#include "util/stage_timer.h"
#include "util/time_budget.h"

namespace cpslam {

/// Makes snapshots for a SnapshotBoard when somebody wishes for them; those that are wanted when they are
/// cheap cost no more than kShare of the time that tracking takes, however large the map. One thread.
class SnapshotPublisher {
 public:
  using MakeFrame = std::function<FrameSnapshot()>;
  using MakeMap = std::function<MapSnapshot()>;

  SnapshotPublisher(std::shared_ptr<SnapshotBoard> board, StageTimer& timer);

  /// After a frame that took tracking_ms.
  void offer(double tracking_ms, const MakeFrame& make_frame, const MakeMap& make_map);
  /// At the end: whatever it costs.
  void publish_map(const MakeMap& make_map);

  static constexpr double kShare = 0.045;

 private:
  void publish_frame(const MakeFrame& make_frame);

  const std::shared_ptr<SnapshotBoard> board_;
  StageTimer& timer_;
  TimeBudget frame_budget_{0.65 * kShare};
  TimeBudget map_budget_{0.35 * kShare};
};

}  // namespace cpslam
