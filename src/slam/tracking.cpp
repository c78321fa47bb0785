#include "slam/tracking.h"

#include <algorithm>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <utility>

#include "geometry/world_point.h"
#include "slam/keyframe_inserter.h"
#include "slam/motion_tracker.h"
#include "slam/pose_refinement.h"

namespace cpslam {
namespace {

// A prediction is worth handing out for a third of a second; after that the camera may be anywhere.
constexpr double kPredictionS = 0.34;
// A hand or a robot moves no faster: beyond it the frames before and after do not belong together, and their
// difference predicts nothing.
constexpr double kMaxSpeedMPerS = 5.0;
constexpr double kMaxTurnRadPerS = 12.0;
// So many times Tracking.minInliers make a pose more than a weak one.
constexpr int kFirmInliers = 2;

/// Seconds; 0 for never. What no loop can ever connect would stay apart, so without loops the camera is
/// looked for where it has been, as long as it takes.
double begins_another_map_after(const Settings& settings, const Places* places) {
  const bool connectable = places != nullptr && settings.loops.enabled;
  return connectable ? settings.tracking.new_map_after_s : 0.0;
}

PoseCovariance to_array(const Eigen::Matrix<double, 6, 6>& covariance) {
  PoseCovariance array{};
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(array.data()) = covariance;
  return array;
}

}  // namespace

Tracking::Tracking(const Rig& rig, Map& map, const Places* places, StageTimer& timer, Log log,
                   std::vector<LoggedFrame> earlier)
    : rig_(rig),
      map_(map),
      timer_(timer),
      log_(std::move(log)),
      localizing_(rig.settings.localization),
      placer_(rig, map, places, timer),
      trajectory_(std::move(earlier)),
      new_map_(begins_another_map_after(rig.settings, places)) {
  // In a loaded map the camera is somewhere, only nobody knows where yet.
  if (map.n_keyframes() > 0) state_ = TrackingState::kLost;
}

KeyFrameId Tracking::take_keyframe() {
  return std::exchange(new_keyframe_, KeyFrameId{});
}

TrackResult Tracking::track(double time_s, std::shared_ptr<const FrameFeatures> features, MapperLoad load) {
  Frame frame;
  frame.index = n_frames_++;
  frame.time_s = time_s;
  frame.matches.resize(static_cast<std::size_t>(features->size()));
  frame.features = std::move(features);
  TrackResult result;
  result.time_s = time_s;
  result.n_keypoints = frame.features->size();
  if (state_ == TrackingState::kNotInitialized) {
    if (!initialize(frame)) return result;
    result.keyframe = true;
    finish_tracked(std::move(frame), result);
  } else if (place(frame)) {
    update_velocity(frame);
    if (!localizing_) count_visible(frame);
    best_inliers_ = std::max(best_inliers_, placement_.inliers);
    result.keyframe = should_insert(frame, load);
    if (result.keyframe) insert(frame);
    finish_tracked(std::move(frame), result);
  } else if (begin_another_map(frame)) {
    result.keyframe = true;
    finish_tracked(std::move(frame), result);
  } else {
    finish_untracked(frame, result);
  }
  return result;
}

bool Tracking::could_begin_map(const Frame& frame) const {
  const auto& depths = frame.features->depth_m;
  const auto with_depth = std::count_if(depths.begin(), depths.end(), [](float d) { return d > 0.0F; });
  return with_depth >= rig_.settings.tracking.min_initial_points;
}

bool Tracking::initialize(Frame& frame) {
  if (!could_begin_map(frame)) return false;
  insert(frame);
  placement_.inliers =
      static_cast<int>(std::count_if(frame.matches.begin(), frame.matches.end(), [](const PointMatch& m) {
        return m.kind == PointMatch::Kind::kMapPoint;
      }));
  log_.info("map " + std::to_string(session_of(new_keyframe_)) + " started with " +
            std::to_string(placement_.inliers) + " points");
  return true;
}

bool Tracking::begin_another_map(Frame& frame) {
  // In a loaded map that the camera has not been found in yet, its user wants to know where in it he is.
  if (!has_last() || localizing_ || !new_map_.is_due(frame.time_s, could_begin_map(frame))) return false;
  frame.cam_from_world = SE3();
  frame.matches.assign(frame.matches.size(), PointMatch{});
  placement_ = {};
  velocity_ = SE3();
  velocity_interval_s_ = 0.0;
  state_ = TrackingState::kNotInitialized;
  new_map_.begun();
  return initialize(frame);
}

int Tracking::session() const {
  return session_of(last_reference_);
}

int Tracking::session_of(KeyFrameId keyframe) const {
  const std::shared_lock lock(map_.mutex());
  return map_.session_of(keyframe);
}

bool Tracking::place(Frame& frame) {
  while (true) {
    const std::uint64_t corrections = refresh_last();
    // Who has left the map while localising is carried on until he is back, whatever was asked for meanwhile.
    const bool may_bridge = localizing_ || placement_.bridged;
    const PlacementPrior prior{last_, last_inliers_, predicted_pose(frame.time_s), frames_without_pose_ > 0,
                               may_bridge};
    std::optional<Placement> placement = placer_.place(prior, frame);
    // The frame may have been placed half in the map before and half in the one after a loop was closed.
    if (corrections != present_corrections()) continue;
    if (!placement) return false;
    placement_ = *std::move(placement);
    return true;
  }
}

std::uint64_t Tracking::refresh_last() {
  // What mapper and loop closing did since the last frame moves that frame's points and pose.
  const auto scope = timer_.time("track: refresh");
  const std::shared_lock lock(map_.mutex());
  const auto reference_from_world = map_.cam_from_world(last_reference_);
  refresh_frame(map_,
                reference_from_world ? last_from_reference_ * *reference_from_world : last_.cam_from_world,
                last_);
  return map_.corrections();
}

std::uint64_t Tracking::present_corrections() const {
  const std::shared_lock lock(map_.mutex());
  return map_.corrections();
}

void Tracking::count_visible(const Frame& frame) {
  const auto scope = timer_.time("track: statistics of points");
  std::vector<MapPointId> found;
  for (const PointMatch& match : frame.matches) {
    if (match.kind == PointMatch::Kind::kMapPoint) found.push_back(match.id);
  }
  std::sort(found.begin(), found.end());
  const std::unique_lock lock(map_.mutex());
  for (const MapPointId id : placement_.expected) {
    map_.count_visible(id, std::binary_search(found.begin(), found.end(), id));
  }
}

bool Tracking::should_insert(const Frame& frame, MapperLoad load) const {
  if (localizing_ || placement_.bridged) return false;
  KeyFrameEvidence evidence;
  evidence.inliers = placement_.inliers;
  for (std::size_t i = 0; i < frame.matches.size(); ++i) {
    const double depth_m = frame.features->depth_m[i];
    if (depth_m <= 0.0 || depth_m > rig_.close_depth_m) continue;
    const bool tracked = frame.matches[i].kind == PointMatch::Kind::kMapPoint;
    ++(tracked ? evidence.close_tracked : evidence.close_untracked);
  }
  evidence.best_inliers = best_inliers_;
  evidence.mapper_load = load;
  return wants_keyframe(evidence);
}

void Tracking::insert(Frame& frame) {
  const auto scope = timer_.time("track: keyframe");
  new_keyframe_ = insert_keyframe(rig_, map_, placement_, frame);
  placement_ = placer_.place_keyframe(new_keyframe_, placement_);
  // The map may have been moved between the two: they are one, wherever that is.
  frame.cam_from_world = placement_.reference_from_world;
  best_inliers_ = 0;
}

void Tracking::update_velocity(const Frame& frame) {
  velocity_ = SE3();
  velocity_interval_s_ = 0.0;
  if (state_ != TrackingState::kTracked || frame.index != last_.index + 1) return;
  const SE3 moved = frame.cam_from_world * last_.cam_from_world.inverse();
  const double interval_s = frame.time_s - last_.time_s;
  if (moved.translation.norm() > kMaxSpeedMPerS * interval_s) return;
  if (rotation_angle(moved.rotation) > kMaxTurnRadPerS * interval_s) return;
  velocity_ = moved;
  velocity_interval_s_ = interval_s;
}

void Tracking::finish_tracked(Frame frame, TrackResult& result) {
  if (state_ == TrackingState::kLost || state_ == TrackingState::kPredicted) {
    log_.info((has_last() ? "tracking found again after " : "found in the loaded map after ") +
              std::to_string(frames_without_pose_) + " frames");
  }
  state_ = TrackingState::kTracked;
  frames_without_pose_ = 0;
  last_reference_ = placement_.reference;
  last_from_reference_ = frame.cam_from_world * placement_.reference_from_world.inverse();
  last_inliers_ = placement_.inliers;
  new_map_.found(frame.time_s, result.keyframe);
  trajectory_.add(frame.time_s, last_reference_, last_from_reference_);
  const bool firm = !placement_.bridged &&
                    placement_.inliers >= kFirmInliers * rig_.settings.tracking.min_inliers &&
                    is_well_determined(placement_.covariance);
  result.state = firm ? TrackingState::kTracked : TrackingState::kWeak;
  result.n_inliers = placement_.inliers;
  result.map = session();
  result.bridged = placement_.bridged;
  // A twist to the left of cam_from_world is one in the camera's own frame, to the right of its inverse.
  if (!placement_.bridged) result.covariance = to_array(placement_.covariance);
  result.world_from_camera = to_pose(frame.cam_from_world.inverse());
  last_ = std::move(frame);
  add_temporary_points(rig_, last_);
}

void Tracking::finish_untracked(const Frame& frame, TrackResult& result) {
  ++frames_without_pose_;
  const bool predictable = has_last() && frame.time_s - last_.time_s <= kPredictionS;
  if (!predictable && state_ != TrackingState::kLost)
    log_.warning("tracking lost; looking for known keyframes");
  state_ = predictable ? TrackingState::kPredicted : TrackingState::kLost;
  result.state = state_;
  result.n_inliers = 0;
  if (!predictable) return;
  result.world_from_camera = to_pose(predicted_pose(frame.time_s).inverse());
  result.map = session();
}

std::vector<bool> Tracking::tracked_keypoints() const {
  std::vector<bool> tracked;
  if (state_ != TrackingState::kTracked) return tracked;
  for (const PointMatch& match : last_.matches) tracked.push_back(match.kind == PointMatch::Kind::kMapPoint);
  return tracked;
}

std::vector<WorldPoint> Tracking::tracked_points() const {
  std::vector<WorldPoint> points;
  if (state_ != TrackingState::kTracked) return points;
  for (const PointMatch& match : last_.matches) {
    if (match.kind == PointMatch::Kind::kMapPoint) points.push_back(to_world_point(match.position_in_world));
  }
  return points;
}

SE3 Tracking::predicted_pose(double time_s) const {
  return expected_motion(time_s - last_.time_s) * last_.cam_from_world;
}

SE3 Tracking::expected_motion(double dt_s) const {
  if (velocity_interval_s_ <= 0.0) return {};
  // Constant velocity, scaled to the time that really passed: frames get dropped. Not for long: it is a
  // guess.
  constexpr double kMaxSteps = 3.0;
  return SE3::exp(std::min(dt_s / velocity_interval_s_, kMaxSteps) * velocity_.log());
}

}  // namespace cpslam
