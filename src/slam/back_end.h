#pragma once

#include <atomic>
#include <cstddef>
#include <optional>

#include "map/map.h"
#include "slam/keyframe_decision.h"
#include "slam/local_mapping.h"
#include "slam/loop_closing.h"
#include "slam/places.h"
#include "slam/rig.h"
#include "util/log.h"
#include "util/stage_timer.h"
#include "util/worker.h"

namespace cpslam {

/// What is done with keyframes beside tracking: LocalMapping, LoopClosing and the bundle adjustment of the
/// whole map, each in a thread of its own; with Settings::sequential one after the other in the caller's.
/// Members may be called from one thread at a time, statistics() from any.
///
/// Who moves the map as a whole first has the mapper stand between two keyframes, because a local bundle
/// adjustment under way would write poses back that are none any more. Only the loop thread starts and stops
/// the full bundle adjustment, and has it stand still before it moves anything itself.
class BackEnd {
 public:
  /// places: null without recognition of places; then nobody looks for loops.
  BackEnd(const Rig& rig, Map& map, Places* places, StageTimer& timer, const Log& log);
  ~BackEnd();
  BackEnd(const BackEnd&) = delete;
  BackEnd& operator=(const BackEnd&) = delete;

  /// Takes over a new keyframe; waits while the mapper's queue is full.
  void add(KeyFrameId keyframe);

  /// Offline frames come as fast as they are tracked, so that many would be placed in a map that is still
  /// being worked on; real time grants a few frames' time. Waits as if time passed. Throws what a thread
  /// threw.
  void let_catch_up();

  /// What the mapper has to do, as far as decisions may depend on it.
  [[nodiscard]] MapperLoad load() const;

  /// Finishes all work and ends the threads. Throws what one of them threw. Idempotent.
  void finish();

  [[nodiscard]] std::size_t local_bundle_adjustments() const { return mapping_.bundle_adjustments(); }
  [[nodiscard]] LoopStatistics loop_statistics() const;

 private:
  struct FullBundleRequest {};
  class MapperPause;

  void start_threads();
  void stop_threads();
  void map_keyframe(KeyFrameId keyframe);
  void look_for_loop(KeyFrameId keyframe);
  void adjust_everything();

  const Rig& rig_;
  Map& map_;
  StageTimer& timer_;
  LocalMapping mapping_;
  std::optional<LoopClosing> loops_;
  std::atomic<bool> abort_mapping_ = false;      // the bundle adjustment under way
  std::atomic<bool> abort_full_bundle_ = false;  // the same of the whole map
  std::atomic<bool> stopping_ = false;
  std::atomic<std::size_t> full_bundles_ = 0;
  std::atomic<std::size_t> full_bundles_given_up_ = 0;
  std::optional<Worker<FullBundleRequest>> full_bundle_thread_;
  std::optional<Worker<KeyFrameId>> loop_thread_;
  std::optional<Worker<KeyFrameId>> mapper_thread_;
  std::size_t frames_since_keyframe_ = 0;
};

}  // namespace cpslam
