#include "cpslam/system.h"

#include <atomic>
#include <cmath>
#include <optional>
#include <shared_mutex>

#include "cpslam/error.h"
#include "features/image_check.h"
#include "slam/frame_input.h"
#include "slam/local_mapping.h"
#include "slam/rig.h"
#include "slam/tracking.h"
#include "util/worker.h"

namespace cpslam {
namespace {

constexpr std::size_t kMaxFramesAhead = 2;

Settings checked(const Settings& settings) {
  settings.check();
  return settings;
}

}  // namespace

class System::Impl {
 public:
  Impl(const Settings& settings, LogSink log)
      : log_(std::move(log)),
        rig_(checked(settings)),
        map_(rig_.pyramid),
        features_(rig_.settings.camera, rig_.settings.orb),
        mapping_(rig_, map_, timer_),
        tracking_(rig_, map_, timer_, log_) {
    if (rig_.settings.sequential) return;
    mapper_.emplace(
        [this](KeyFrameId&& id, const std::stop_token& stop) {
          if (stop.stop_requested()) return;
          abort_ = false;
          mapping_.process(id, abort_);
        },
        static_cast<std::size_t>(rig_.settings.mapping.queue_capacity));
    mapper_->start();
  }

  ~Impl() {
    abort_ = true;
    if (mapper_) mapper_->stop(OnStop::kDrop);
  }

  TrackResult track(const cv::Mat& colour, const cv::Mat& depth, double time_s, double depth_time_s) {
    check_input(colour, depth, time_s, depth_time_s);
    let_mapper_catch_up();
    if (!last_time_s_) warn_about_depth_scale(depth, rig_.settings.camera.depth_map_factor, log_);
    last_time_s_ = time_s;
    TrackResult result;
    {
      const auto scope = timer_.time("track");
      std::shared_ptr<const FrameFeatures> features;
      {
        const auto extraction = timer_.time("track: features");
        features = features_.build(to_grey(colour), depth, tracking_.expected_motion(depth_time_s - time_s));
      }
      result = tracking_.track(time_s, std::move(features), mapper_load());
    }
    count(result.state);
    // After the clock has stopped: mapping in this thread, or waiting for the mapper, is not tracking.
    if (const KeyFrameId keyframe = tracking_.take_keyframe(); keyframe.valid()) hand_to_mapper(keyframe);
    return result;
  }

  void shutdown() {
    if (finished_) return;
    finished_ = true;
    if (!mapper_) return;
    mapper_->stop(OnStop::kDrain);
    mapper_->rethrow_if_failed();
  }

  [[nodiscard]] Trajectory trajectory() const { return tracking_.trajectory(); }
  [[nodiscard]] Trajectory keyframe_trajectory() const { return keyframe_poses(map_); }

  [[nodiscard]] Statistics statistics() const {
    Statistics statistics = counts_;
    statistics.local_bundle_adjustments = mapping_.bundle_adjustments();
    statistics.stages = timer_.summary();
    const std::shared_lock lock(map_.mutex());
    statistics.keyframes = map_.n_keyframes();
    statistics.keyframes_created = map_.keyframes_created();
    statistics.map_points = map_.n_points();
    statistics.map_points_created = map_.points_created();
    return statistics;
  }

 private:
  void check_input(const cv::Mat& colour, const cv::Mat& depth, double time_s, double depth_time_s) const {
    if (finished_) throw RunError("track() was called after shutdown()");
    check_images(colour, depth, {rig_.camera.width(), rig_.camera.height()});
    if (!std::isfinite(time_s) || !std::isfinite(depth_time_s))
      throw InputError("the frame's time stamp is not a finite number");
    if (last_time_s_ && time_s <= *last_time_s_) {
      throw InputError("the frame's time stamp " + std::to_string(time_s) +
                       " does not come after the last one's " + std::to_string(*last_time_s_));
    }
  }

  void hand_to_mapper(KeyFrameId id) {
    if (!mapper_) {
      mapping_.process(id, abort_);
      return;
    }
    const auto scope = timer_.time("wait for mapper");
    // In real time a new keyframe is worth more than the last iterations of the bundle adjustment under way.
    if (rig_.settings.realtime) abort_ = true;
    mapper_->push(id);
    frames_since_keyframe_ = 0;
  }

  /// Offline frames come as fast as they are tracked, so that many would be placed in a map that the mapper
  /// is still working on; real time grants it a few frames' time. Wait as if time passed.
  void let_mapper_catch_up() {
    if (!mapper_ || rig_.settings.realtime || frames_since_keyframe_++ < kMaxFramesAhead) return;
    const auto scope = timer_.time("wait for mapper");
    mapper_->wait_idle();
  }

  [[nodiscard]] MapperLoad mapper_load() const {
    // Offline the result must not depend on how fast the machine is.
    if (!mapper_ || !rig_.settings.realtime) return MapperLoad::kIdle;
    const std::size_t load = mapper_->load();
    if (load == 0) return MapperLoad::kIdle;
    return load < mapper_->capacity() ? MapperLoad::kBusy : MapperLoad::kFull;
  }

  void count(TrackingState state) {
    ++counts_.frames;
    switch (state) {
      case TrackingState::kTracked:
        ++counts_.tracked;
        break;
      case TrackingState::kPredicted:
        ++counts_.predicted;
        break;
      case TrackingState::kLost:
        ++counts_.lost;
        break;
      case TrackingState::kNotInitialized:
        ++counts_.not_initialized;
        break;
    }
  }

  const Log log_;
  const Rig rig_;
  StageTimer timer_;
  Map map_;
  FrameFeaturesBuilder features_;
  LocalMapping mapping_;
  Tracking tracking_;
  std::atomic<bool> abort_ = false;
  std::optional<Worker<KeyFrameId>> mapper_;
  Statistics counts_;
  std::optional<double> last_time_s_;
  std::size_t frames_since_keyframe_ = 0;
  bool finished_ = false;
};

System::System(const Settings& settings, LogSink log)
    : impl_(std::make_unique<Impl>(settings, std::move(log))) {}
System::~System() = default;
TrackResult System::track(const cv::Mat& colour, const cv::Mat& depth, double time_s) {
  return impl_->track(colour, depth, time_s, time_s);
}
TrackResult System::track(const cv::Mat& colour, const cv::Mat& depth, double time_s, double depth_time_s) {
  return impl_->track(colour, depth, time_s, depth_time_s);
}
void System::shutdown() {
  impl_->shutdown();
}
Trajectory System::trajectory() const {
  return impl_->trajectory();
}
Trajectory System::keyframe_trajectory() const {
  return impl_->keyframe_trajectory();
}
Statistics System::statistics() const {
  return impl_->statistics();
}

}  // namespace cpslam
