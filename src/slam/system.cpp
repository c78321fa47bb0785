#include "cpslam/system.h"

#include <atomic>
#include <cmath>
#include <optional>
#include <shared_mutex>

#include "cpslam/error.h"
#include "detect/people.h"
#include "features/image_check.h"
#include "place/vocabulary_file.h"
#include "slam/frame_input.h"
#include "slam/local_mapping.h"
#include "slam/places.h"
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

/// Null when no place is to be recognised.
std::unique_ptr<Places> make_places(const Settings& settings) {
  if (settings.vocabulary.empty()) return nullptr;
  return std::make_unique<Places>(load_vocabulary(settings.vocabulary));
}

}  // namespace

class System::Impl {
 public:
  Impl(const Settings& settings, std::unique_ptr<PersonDetector> detector, LogSink log)
      : log_(std::move(log)),
        rig_(checked(settings)),
        map_(rig_.pyramid),
        places_(make_places(rig_.settings)),
        features_(rig_.settings.camera, rig_.settings.orb),
        people_(rig_.settings, std::move(detector), timer_, log_),
        mapping_(rig_, map_, places_.get(), timer_),
        tracking_(rig_, map_, places_.get(), timer_, log_) {
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

  TrackResult track(const RgbdFrame& frame) {
    const double depth_time_s = frame.depth_time_s.value_or(frame.time_s);
    check_input(frame, depth_time_s);
    let_mapper_catch_up();
    if (!last_time_s_) warn_about_depth_scale(frame.depth, rig_.settings.camera.depth_map_factor, log_);
    const double interval_s = frame.time_s - last_time_s_.value_or(frame.time_s);
    last_time_s_ = frame.time_s;
    TrackResult result;
    {
      const auto scope = timer_.time("track");
      people_.begin(frame, tracking_.expected_motion(interval_s));
      std::shared_ptr<const FrameFeatures> features = static_features(frame, depth_time_s - frame.time_s);
      result = tracking_.track(frame.time_s, std::move(features), mapper_load());
      people_.end(tracking_.expected_motion(interval_s), result.state == TrackingState::kTracked);
    }
    count(result.state);
    // After the clock has stopped: mapping in this thread, or waiting for the mapper, is not tracking.
    if (const KeyFrameId keyframe = tracking_.take_keyframe(); keyframe.valid()) hand_to_mapper(keyframe);
    return result;
  }

  void shutdown() {
    if (finished_) return;
    finished_ = true;
    people_.finish();
    if (!mapper_) return;
    mapper_->stop(OnStop::kDrain);
    mapper_->rethrow_if_failed();
  }

  [[nodiscard]] Trajectory trajectory() const { return tracking_.trajectory(); }
  [[nodiscard]] Trajectory keyframe_trajectory() const { return keyframe_poses(map_); }

  [[nodiscard]] FrameView frame_view() const {
    FrameView view;
    view.time_s = last_time_s_.value_or(0.0);
    if (candidates_ != nullptr) show_keypoints(view);
    people_.show(view);
    return view;
  }

  [[nodiscard]] Statistics statistics() const {
    Statistics statistics = counts_;
    statistics.local_bundle_adjustments = mapping_.bundle_adjustments();
    statistics.people = people_.statistics();
    statistics.stages = timer_.summary();
    const std::shared_lock lock(map_.mutex());
    statistics.keyframes = map_.n_keyframes();
    statistics.keyframes_created = map_.keyframes_created();
    statistics.map_points = map_.n_points();
    statistics.map_points_created = map_.points_created();
    return statistics;
  }

 private:
  void check_input(const RgbdFrame& frame, double depth_time_s) const {
    if (finished_) throw RunError("track() was called after shutdown()");
    check_images(frame.colour, frame.depth, {rig_.camera.width(), rig_.camera.height()});
    people_.check(frame);
    const double time_s = frame.time_s;
    if (!std::isfinite(time_s) || !std::isfinite(depth_time_s))
      throw InputError("the frame's time stamp is not a finite number");
    if (last_time_s_ && time_s <= *last_time_s_) {
      throw InputError("the frame's time stamp " + std::to_string(time_s) +
                       " does not come after the last one's " + std::to_string(*last_time_s_));
    }
  }

  /// The features of the frame that are not on people.
  std::shared_ptr<const FrameFeatures> static_features(const RgbdFrame& frame, double depth_delay_s) {
    {
      const auto scope = timer_.time("track: features");
      candidates_ = &features_.extract(to_grey(frame.colour), frame.depth,
                                       tracking_.expected_motion(depth_delay_s), people_.prior());
    }
    kept_ = people_.filter(*candidates_);
    if (const int missing = people_.missing_keypoints(kept_); missing > 0) {
      features_.extend(*candidates_, people_.excluded(), missing);
      kept_ = people_.filter(*candidates_);
    }
    return features_.finish(*candidates_, kept_);
  }

  void show_keypoints(FrameView& view) const {
    const std::vector<bool> tracked = tracking_.tracked_keypoints();
    std::size_t n_kept = 0;
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      const OrbKeypoint& k = candidates_->orb.keypoints[i];
      FrameView::Kind kind = FrameView::Kind::kRemoved;
      if (kept_[i] != 0) {
        const bool holds_point = n_kept < tracked.size() && tracked[n_kept];
        kind = holds_point ? FrameView::Kind::kTracked : FrameView::Kind::kKept;
        ++n_kept;
      }
      view.keypoints.push_back({k.x, k.y, kind});
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
  std::unique_ptr<Places> places_;
  FrameFeaturesBuilder features_;
  People people_;
  LocalMapping mapping_;
  Tracking tracking_;
  std::atomic<bool> abort_ = false;
  std::optional<Worker<KeyFrameId>> mapper_;
  Statistics counts_;
  std::optional<double> last_time_s_;
  std::size_t frames_since_keyframe_ = 0;
  KeypointCandidates* candidates_ = nullptr;  // of the last frame; features_ owns them
  std::vector<std::uint8_t> kept_;            // parallel to them
  bool finished_ = false;
};

System::System(const Settings& settings, LogSink log)
    : System(settings, make_detector(settings.detector, log), log) {}
System::System(const Settings& settings, std::unique_ptr<PersonDetector> detector, LogSink log)
    : impl_(std::make_unique<Impl>(settings, std::move(detector), std::move(log))) {}
System::~System() = default;
TrackResult System::track(const cv::Mat& colour, const cv::Mat& depth, double time_s) {
  return impl_->track({colour, depth, time_s, {}, {}, {}});
}
TrackResult System::track(const cv::Mat& colour, const cv::Mat& depth, double time_s, double depth_time_s) {
  return impl_->track({colour, depth, time_s, depth_time_s, {}, {}});
}
TrackResult System::track(const RgbdFrame& frame) {
  return impl_->track(frame);
}
FrameView System::frame_view() const {
  return impl_->frame_view();
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
