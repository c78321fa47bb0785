#include "slam/back_end.h"

#include <mutex>

#include "slam/full_bundle.h"

namespace cpslam {
namespace {

constexpr std::size_t kMaxFramesAhead = 2;
constexpr std::size_t kLoopQueue = 256;          // ids only; what does not fit is never looked at for loops
constexpr std::size_t kMaxKeyframesBehind = 10;  // of the loop thread, offline

}  // namespace

/// Has the mapper stand between two keyframes as long as it lives. Never two at a time.
class BackEnd::MapperPause {
 public:
  explicit MapperPause(BackEnd& back_end) : thread_(back_end.mapper_thread_) {
    if (!thread_) return;
    std::future<void> paused = thread_->pause();
    back_end.abort_mapping_ = true;
    paused.get();
  }
  ~MapperPause() {
    if (thread_) thread_->resume();
  }
  MapperPause(const MapperPause&) = delete;
  MapperPause& operator=(const MapperPause&) = delete;

 private:
  std::optional<Worker<KeyFrameId>>& thread_;
};

BackEnd::BackEnd(const Rig& rig, Map& map, Places* places, StageTimer& timer, const Log& log)
    : rig_(rig), map_(map), timer_(timer), mapping_(rig, map, places, timer) {
  if (places != nullptr && rig.settings.loops.enabled) loops_.emplace(rig, map, *places, timer, log);
  if (!rig.settings.sequential) start_threads();
}

BackEnd::~BackEnd() {
  stop_threads();
}

void BackEnd::start_threads() {
  if (loops_) {
    full_bundle_thread_.emplace([this](FullBundleRequest&&, const std::stop_token&) { adjust_everything(); },
                                1);
    loop_thread_.emplace(
        [this](KeyFrameId&& id, const std::stop_token& stop) {
          if (!stop.stop_requested()) look_for_loop(id);
        },
        kLoopQueue);
    full_bundle_thread_->start();
    loop_thread_->start();
  }
  mapper_thread_.emplace(
      [this](KeyFrameId&& id, const std::stop_token& stop) {
        if (!stop.stop_requested()) map_keyframe(id);
      },
      static_cast<std::size_t>(rig_.settings.mapping.queue_capacity));
  mapper_thread_->start();
}

void BackEnd::stop_threads() {
  stopping_ = true;
  abort_mapping_ = true;
  abort_full_bundle_ = true;
  // The later stages first: they may be waiting for the mapper to stand still, so it has to live longest.
  if (loop_thread_) loop_thread_->stop(OnStop::kDrop);
  if (full_bundle_thread_) full_bundle_thread_->stop(OnStop::kDrop);
  if (mapper_thread_) mapper_thread_->stop(OnStop::kDrop);
}

void BackEnd::add(KeyFrameId keyframe) {
  if (!mapper_thread_) {
    map_keyframe(keyframe);
    if (loops_) look_for_loop(keyframe);
    return;
  }
  const auto scope = timer_.time("wait for mapper");
  // In real time a new keyframe is worth more than the last iterations of the bundle adjustment under way.
  if (rig_.settings.realtime) abort_mapping_ = true;
  mapper_thread_->push(keyframe);
  frames_since_keyframe_ = 0;
}

void BackEnd::let_catch_up() {
  if (!mapper_thread_) return;
  if (loop_thread_) loop_thread_->rethrow_if_failed();
  if (full_bundle_thread_) full_bundle_thread_->rethrow_if_failed();
  if (rig_.settings.realtime || frames_since_keyframe_++ < kMaxFramesAhead) return;
  const auto scope = timer_.time("wait for mapper");
  if (loop_thread_) loop_thread_->wait_load_below(kMaxKeyframesBehind);
  mapper_thread_->wait_idle();
}

MapperLoad BackEnd::load() const {
  // Offline the result must not depend on how fast the machine is.
  if (!mapper_thread_ || !rig_.settings.realtime) return MapperLoad::kIdle;
  const std::size_t load = mapper_thread_->load();
  if (load == 0) return MapperLoad::kIdle;
  return load < mapper_thread_->capacity() ? MapperLoad::kBusy : MapperLoad::kFull;
}

void BackEnd::finish() {
  // In the order in which they feed each other; a stopped mapper could not be paused by those behind it.
  if (mapper_thread_) mapper_thread_->wait_idle();
  if (loop_thread_) loop_thread_->wait_idle();
  if (full_bundle_thread_) full_bundle_thread_->wait_idle();
  stop_threads();
}

LoopStatistics BackEnd::loop_statistics() const {
  LoopStatistics statistics;
  if (loops_) statistics = loops_->statistics();
  statistics.full_bundle_adjustments = full_bundles_;
  statistics.full_bundle_adjustments_given_up = full_bundles_given_up_;
  return statistics;
}

void BackEnd::map_keyframe(KeyFrameId keyframe) {
  abort_mapping_ = stopping_.load();
  mapping_.process(keyframe, abort_mapping_);
  // Never waits: the loop thread may at this moment be waiting for the mapper to stand still.
  if (loop_thread_) loop_thread_->try_push(keyframe);
}

void BackEnd::look_for_loop(KeyFrameId keyframe) {
  const std::optional<VerifiedLoop> loop = loops_->find(keyframe);
  if (!loop) return;
  if (full_bundle_thread_) {
    abort_full_bundle_ = true;
    full_bundle_thread_->wait_idle();
  }
  {
    const MapperPause pause(*this);
    if (!loops_->close(*loop, stopping_)) return;
  }
  abort_full_bundle_ = stopping_.load();
  if (full_bundle_thread_) {
    full_bundle_thread_->push({});
  } else {
    adjust_everything();
  }
}

void BackEnd::adjust_everything() {
  std::optional<FullBundle> bundle;
  {
    const auto scope = timer_.time("loop: full bundle adjustment");
    bundle = adjust_full_bundle(rig_, map_, abort_full_bundle_);
  }
  if (!bundle) {
    ++full_bundles_given_up_;
    return;
  }
  const MapperPause pause(*this);
  const auto scope = timer_.time("loop: moving the map");
  const std::unique_lock lock(map_.mutex());
  write_back(map_, *bundle);
  ++full_bundles_;
}

}  // namespace cpslam
