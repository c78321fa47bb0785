#include "cpslam/system.h"

#include <chrono>
#include <cmath>
#include <optional>
#include <shared_mutex>

#include "cpslam/error.h"
#include "dense/dense_map_impl.h"
#include "detect/people.h"
#include "features/image_check.h"
#include "place/vocabulary_file.h"
#include "slam/back_end.h"
#include "slam/frame_input.h"
#include "slam/map_archive.h"
#include "slam/map_snapshot.h"
#include "slam/places.h"
#include "slam/rig.h"
#include "slam/snapshot_publisher.h"
#include "slam/tracking.h"

namespace cpslam {
namespace {

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
        loaded_(load_map(rig_, map_, places_.get(), log_)),
        features_(rig_.settings.camera, rig_.settings.orb),
        people_(rig_.settings, std::move(detector), timer_, log_),
        tracking_(rig_, map_, places_.get(), timer_, log_,
                  loaded_ ? std::move(loaded_->frames) : std::vector<LoggedFrame>()),
        back_end_(rig_, map_, places_.get(), timer_, log_) {
    const DenseSettings& dense = rig_.settings.dense;
    if (dense.enabled)
      dense_views_.emplace(rig_.camera, static_cast<std::size_t>(dense.memory_mb) << 20U, log_);
  }

  TrackResult track(const RgbdFrame& frame) {
    const double depth_time_s = frame.depth_time_s.value_or(frame.time_s);
    check_input(frame, depth_time_s);
    back_end_.let_catch_up();
    if (!last_time_s_) warn_about_depth_scale(frame.depth, rig_.settings.camera.depth_map_factor, log_);
    const double interval_s = frame.time_s - last_time_s_.value_or(frame.time_s);
    last_time_s_ = frame.time_s;
    TrackResult result;
    const auto start = std::chrono::steady_clock::now();
    {
      const auto scope = timer_.time("track");
      people_.begin(frame, tracking_.expected_motion(interval_s));
      std::shared_ptr<const FrameFeatures> features = static_features(frame, depth_time_s - frame.time_s);
      result = tracking_.track(frame.time_s, std::move(features), back_end_.load());
      people_.end(tracking_.expected_motion(interval_s), is_tracked(result.state));
    }
    const std::chrono::duration<double, std::milli> duration = std::chrono::steady_clock::now() - start;
    count(result);
    // After the clock has stopped: mapping in this thread, or waiting for the mapper, is not tracking.
    if (const KeyFrameId keyframe = tracking_.take_keyframe(); keyframe.valid()) {
      if (dense_views_) add_dense_view(keyframe, frame, depth_time_s - frame.time_s);
      back_end_.add(keyframe);
    }
    publish(frame.colour, result, duration.count());
    return result;
  }

  void shutdown() {
    if (finished_) return;
    finished_ = true;
    people_.finish();
    back_end_.finish();
    if (publisher_) publisher_->publish_map([this] { return map_snapshot(); });
  }

  void publish_to(std::shared_ptr<SnapshotBoard> board) {
    publisher_.reset();
    if (board) publisher_.emplace(std::move(board), timer_);
  }

  void save_map(const std::string& path) const {
    cpslam::save_map(path, rig_, map_, places_.get(), tracking_.logged_frames());
  }

  [[nodiscard]] Trajectory trajectory() const { return tracking_.trajectory(); }
  [[nodiscard]] Trajectory keyframe_trajectory() const {
    return keyframe_poses(map_, loaded_ ? loaded_->next_sequence : 0);
  }

  [[nodiscard]] DenseMap dense_map(const DenseMapOptions& options) const {
    if (!dense_views_) throw InputError("there is no dense map without settings.dense.enabled");
    return DenseMap(std::make_unique<const DenseMap::Impl>(
        options, dense_views_->camera(), dense_views_->place(map_), dense_views_->n_dropped()));
  }

  [[nodiscard]] FrameView frame_view() const {
    FrameView view;
    view.time_s = last_time_s_.value_or(0.0);
    if (candidates_ != nullptr) show_keypoints(view);
    people_.show(view);
    return view;
  }

  [[nodiscard]] Statistics statistics() const {
    Statistics statistics = counts_;
    statistics.local_bundle_adjustments = back_end_.local_bundle_adjustments();
    statistics.loops = back_end_.loop_statistics();
    statistics.people = people_.statistics();
    if (loaded_) statistics.loaded_map = loaded_->statistics;
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

  void add_dense_view(KeyFrameId keyframe, const RgbdFrame& frame, double depth_delay_s) {
    const auto scope = timer_.time("dense map: view");
    DenseFrame seen;
    seen.colour = frame.colour;
    seen.depth = frame.depth;
    seen.metres_per_unit = 1.0 / rig_.settings.camera.depth_map_factor;
    seen.moving = people_.moving();
    SE3 depth_cam_from_colour_cam;
    if (depth_delay_s != 0.0) depth_cam_from_colour_cam = tracking_.expected_motion(depth_delay_s);
    seen.colour_cam_from_depth_cam = depth_cam_from_colour_cam.inverse();
    dense_views_->add(keyframe, seen, depth_cam_from_colour_cam, map_);
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

  void publish(const cv::Mat& colour, const TrackResult& result, double tracking_ms) {
    if (!publisher_) return;
    publisher_->offer(
        tracking_ms, [&] { return frame_snapshot(colour, result); }, [&] { return map_snapshot(); });
  }

  [[nodiscard]] FrameSnapshot frame_snapshot(const cv::Mat& colour, const TrackResult& result) const {
    FrameSnapshot snapshot;
    snapshot.index = counts_.frames - 1;
    snapshot.result = result;
    snapshot.image = colour.clone();
    snapshot.view = frame_view();
    snapshot.tracked_points = tracking_.tracked_points();
    if (is_tracked(result.state)) snapshot.people = people_.shapes(from_pose(result.world_from_camera));
    snapshot.stages = timer_.summary();
    return snapshot;
  }

  [[nodiscard]] MapSnapshot map_snapshot() const {
    MapSnapshot snapshot = copy_for_viewer(map_);
    snapshot.trajectory = tracking_.trajectory();
    return snapshot;
  }

  void count(const TrackResult& result) {
    if (loaded_) count_in_loaded_map(result, loaded_->statistics);
    ++counts_.frames;
    switch (result.state) {
      case TrackingState::kWeak:
        ++counts_.weak;
        [[fallthrough]];
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

  void count_in_loaded_map(const TrackResult& result, LoadedMapStatistics& loaded) const {
    if (result.bridged) ++loaded.bridged;
    if (loaded.found_time_s) return;
    if (is_tracked(result.state)) {
      loaded.found_time_s = result.time_s;
    } else {
      ++loaded.frames_before_found;
    }
  }

  const Log log_;
  const Rig rig_;
  StageTimer timer_;
  Map map_;
  std::unique_ptr<Places> places_;
  std::optional<LoadedMap> loaded_;
  FrameFeaturesBuilder features_;
  People people_;
  Tracking tracking_;
  BackEnd back_end_;
  std::optional<DenseViews> dense_views_;  // empty unless a dense map is wanted
  Statistics counts_;
  std::optional<double> last_time_s_;
  KeypointCandidates* candidates_ = nullptr;  // of the last frame; features_ owns them
  std::vector<std::uint8_t> kept_;            // parallel to them
  std::optional<SnapshotPublisher> publisher_;
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
void System::publish_to(std::shared_ptr<SnapshotBoard> board) {
  impl_->publish_to(std::move(board));
}
void System::shutdown() {
  impl_->shutdown();
}
void System::save_map(const std::string& path) const {
  impl_->save_map(path);
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
DenseMap System::dense_map(const DenseMapOptions& options) const {
  return impl_->dense_map(options);
}

}  // namespace cpslam
