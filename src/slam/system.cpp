#include "cpslam/system.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <shared_mutex>

#include "cpslam/error.h"
#include "dense/dense_map_impl.h"
#include "detect/people.h"
#include "features/image_check.h"
#include "place/vocabulary_file.h"
#include "slam/frame_counts.h"
#include "slam/frame_input.h"
#include "slam/live_map.h"
#include "slam/map_archive.h"
#include "slam/map_counts.h"
#include "slam/map_snapshot.h"
#include "slam/places.h"
#include "slam/rig.h"
#include "slam/snapshot_publisher.h"
#include "slam/static_features.h"

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
        places_(make_places(rig_.settings)),
        live_(make_map(true, 0)),
        people_(rig_.settings, std::move(detector), timer_, log_),
        features_(rig_.settings, people_, timer_) {
    if (live_->loaded) counts_.loaded_map = live_->loaded->statistics;
    begin_dense_views();
  }

  TrackResult track(const RgbdFrame& frame) {
    const double depth_time_s = frame.depth_time_s.value_or(frame.time_s);
    check_input(frame, depth_time_s);
    live_->back_end.let_catch_up();
    if (!last_time_s_) warn_about_depth_scale(frame.depth, rig_.settings.camera.depth_map_factor, log_);
    const double interval_s = frame.time_s - last_time_s_.value_or(frame.time_s);
    last_time_s_ = frame.time_s;
    TrackResult result;
    const auto start = std::chrono::steady_clock::now();
    {
      const auto scope = timer_.time("track");
      people_.begin(frame, live_->tracking.expected_motion(interval_s));
      std::shared_ptr<const FrameFeatures> features =
          features_.extract(frame, live_->tracking.expected_motion(depth_time_s - frame.time_s));
      result = live_->tracking.track(frame.time_s, std::move(features), live_->back_end.load());
      people_.end(live_->tracking.expected_motion(interval_s), is_tracked(result.state));
    }
    const std::chrono::duration<double, std::milli> duration = std::chrono::steady_clock::now() - start;
    count(result);
    // After the clock has stopped: mapping in this thread, or waiting for the mapper, is not tracking.
    if (const KeyFrameId keyframe = live_->tracking.take_keyframe(); keyframe.valid()) {
      if (dense_views_) add_dense_view(keyframe, frame, depth_time_s - frame.time_s);
      live_->back_end.add(keyframe);
    }
    publish(frame.colour, result, duration.count());
    return result;
  }

  void set_localization(bool on) {
    if (on && !has_map()) throw InputError("there is no map yet to localise in");
    if (on != live_->tracking.localizing())
      log_.info(on ? "localisation: the map stays as it is" : "mapping goes on");
    live_->tracking.set_localizing(on);
  }

  void reset() {
    if (finished_) throw RunError("reset() was called after shutdown()");
    if (!has_map()) return;
    if (live_->tracking.localizing())
      throw InputError("the map is not dropped while localising in it: switch localisation off first");
    std::unique_ptr<LiveMap> next = make_map(false, live_->sessions_created());
    dropped_.push_back({live_->tracking.trajectory(), live_->keyframe_trajectory()});
    live_.swap(next);
    next->add_work_to(counts_);
    next.reset();  // its threads are at work in the words until here
    if (places_) places_->database.clear();
    begin_dense_views();
    log_.info("map dropped; the poses of its " + std::to_string(dropped_.back().trajectory.size()) +
              " frames are kept");
    if (publisher_) publisher_->publish_map([this] { return map_snapshot(); });
  }

  [[nodiscard]] const std::vector<DroppedMap>& dropped_maps() const { return dropped_; }

  void shutdown() {
    if (finished_) return;
    finished_ = true;
    people_.finish();
    live_->back_end.finish();
    if (publisher_) publisher_->publish_map([this] { return map_snapshot(); });
  }

  void publish_to(std::shared_ptr<SnapshotBoard> board) {
    publisher_.reset();
    if (board) publisher_.emplace(std::move(board), timer_);
  }

  void save_map(const std::string& path) const {
    cpslam::save_map(path, rig_, live_->map, places_.get(), live_->tracking.logged_frames());
  }

  [[nodiscard]] Trajectory trajectory() const { return live_->tracking.trajectory(); }
  [[nodiscard]] Trajectory keyframe_trajectory() const { return live_->keyframe_trajectory(); }

  [[nodiscard]] DenseMap dense_map(const DenseMapOptions& options) const {
    if (!dense_views_) throw InputError("there is no dense map without settings.dense.enabled");
    return DenseMap(std::make_unique<const DenseMap::Impl>(
        options, dense_views_->camera(), dense_views_->place(live_->map, map_with_most_frames()),
        dense_views_->n_dropped()));
  }

  [[nodiscard]] FrameView frame_view() const {
    FrameView view;
    view.time_s = last_time_s_.value_or(0.0);
    features_.show(live_->tracking.tracked_keypoints(), view);
    people_.show(view);
    return view;
  }

  [[nodiscard]] Statistics statistics() const {
    Statistics statistics = counts_;
    live_->add_work_to(statistics);
    statistics.dropped_maps = dropped_.size();
    statistics.people = people_.statistics();
    statistics.stages = timer_.summary();
    statistics.maps = count_maps(live_->map, live_->tracking.trajectory());
    const std::shared_lock lock(live_->map.mutex());
    statistics.keyframes = live_->map.n_keyframes();
    statistics.map_points = live_->map.n_points();
    return statistics;
  }

 private:
  [[nodiscard]] std::unique_ptr<LiveMap> make_map(bool begin_loaded, int maps_before) {
    return std::make_unique<LiveMap>(rig_, places_.get(), begin_loaded, maps_before, timer_, log_);
  }

  [[nodiscard]] bool has_map() const {
    const std::shared_lock lock(live_->map.mutex());
    return live_->map.n_keyframes() > 0;
  }

  void begin_dense_views() {
    const DenseSettings& dense = rig_.settings.dense;
    if (dense.enabled)
      dense_views_.emplace(rig_.camera, static_cast<std::size_t>(dense.memory_mb) << 20U, log_);
  }

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

  void add_dense_view(KeyFrameId keyframe, const RgbdFrame& frame, double depth_delay_s) {
    const auto scope = timer_.time("dense map: view");
    DenseFrame seen;
    seen.colour = frame.colour;
    seen.depth = frame.depth;
    seen.metres_per_unit = 1.0 / rig_.settings.camera.depth_map_factor;
    seen.moving = people_.moving();
    SE3 depth_cam_from_colour_cam;
    if (depth_delay_s != 0.0) depth_cam_from_colour_cam = live_->tracking.expected_motion(depth_delay_s);
    seen.colour_cam_from_depth_cam = depth_cam_from_colour_cam.inverse();
    dense_views_->add(keyframe, seen, depth_cam_from_colour_cam, live_->map);
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
    snapshot.tracked_points = live_->tracking.tracked_points();
    if (is_tracked(result.state)) snapshot.people = people_.shapes(from_pose(result.world_from_camera));
    snapshot.stages = timer_.summary();
    snapshot.localization = live_->tracking.localizing();
    return snapshot;
  }

  [[nodiscard]] MapSnapshot map_snapshot() const {
    MapSnapshot snapshot = copy_for_viewer(live_->map, std::max(1, live_->tracking.session()));
    snapshot.trajectory = live_->tracking.trajectory();
    std::erase_if(snapshot.trajectory, [&](const StampedPose& pose) { return pose.map != snapshot.map; });
    return snapshot;
  }

  [[nodiscard]] int map_with_most_frames() const {
    const std::vector<MapCounts> maps = count_maps(live_->map, live_->tracking.trajectory());
    return maps.empty() ? 1 : maps.front().map;
  }

  void count(const TrackResult& result) {
    count_frame(result, counts_);
    if (live_->loaded) count_frame(result, *counts_.loaded_map);
  }

  const Log log_;
  const Rig rig_;
  StageTimer timer_;
  std::unique_ptr<Places> places_;
  Statistics counts_;              // those of the present map are asked for
  std::unique_ptr<LiveMap> live_;  // never null
  std::vector<DroppedMap> dropped_;
  People people_;
  StaticFeatures features_;
  std::optional<DenseViews> dense_views_;  // empty unless a dense map is wanted
  std::optional<double> last_time_s_;
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
void System::set_localization(bool on) {
  impl_->set_localization(on);
}
void System::reset() {
  impl_->reset();
}
const std::vector<DroppedMap>& System::dropped_maps() const {
  return impl_->dropped_maps();
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
