#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "cpslam/types.h"
#include "map/map.h"
#include "slam/loop_consistency.h"
#include "slam/loop_verification.h"
#include "slam/places.h"
#include "slam/rig.h"
#include "util/log.h"
#include "util/random.h"
#include "util/stage_timer.h"

namespace cpslam {

/// Finds out when the camera is back at a place it has been to without tracking having noticed, and bends the
/// map so that both are one (Mur-Artal et al. 2015, section VII). One thread; statistics() from any.
class LoopClosing {
 public:
  LoopClosing(const Rig& rig, Map& map, Places& places, StageTimer& timer, Log log)
      : rig_(rig),
        map_(map),
        places_(places),
        timer_(timer),
        log_(std::move(log)),
        random_(rig.settings.seed),
        consistency_(rig.settings.loops.consistent_keyframes) {}

  /// Looks for a loop that ends in this keyframe, which Places remembers; for each in the order of their
  /// creation. Takes shared locks of the map.
  [[nodiscard]] std::optional<VerifiedLoop> find(KeyFrameId keyframe);

  /// See close_loop() for what must hold. Returns whether the map was moved.
  bool close(const VerifiedLoop& loop, const std::atomic<bool>& abort);

  [[nodiscard]] LoopStatistics statistics() const;

 private:
  void tell(const LoopEvent& event) const;
  [[nodiscard]] std::vector<KeyFrameId> alike_places(KeyFrameId keyframe,
                                                     const std::vector<KeyFrameId>& connected,
                                                     const ImageWords& words) const;

  const Rig& rig_;
  Map& map_;
  Places& places_;
  StageTimer& timer_;
  Log log_;
  Random random_;
  LoopConsistency consistency_;
  std::optional<std::uint64_t> last_loop_;  // sequence of its current keyframe

  mutable std::mutex mutex_;  // guards the statistics
  LoopStatistics statistics_;
};

}  // namespace cpslam
