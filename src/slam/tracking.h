#pragma once

#include <memory>
#include <vector>

#include "cpslam/types.h"
#include "map/map.h"
#include "slam/frame.h"
#include "slam/frame_placer.h"
#include "slam/keyframe_decision.h"
#include "slam/new_map_decision.h"
#include "slam/rig.h"
#include "slam/trajectory_log.h"
#include "util/log.h"
#include "util/stage_timer.h"

namespace cpslam {

/// Places every frame in the map and decides which become keyframes. One thread.
class Tracking {
 public:
  /// places: null when places are not recognised. earlier: the frames of the map, if it was loaded.
  Tracking(const Rig& rig, Map& map, const Places* places, StageTimer& timer, Log log,
           std::vector<LoggedFrame> earlier = {});

  /// load: what the mapper has to do, as far as it may influence the decision for a keyframe.
  TrackResult track(double time_s, std::shared_ptr<const FrameFeatures> features, MapperLoad load);

  /// On: frames are only placed, in a map that nothing is added to. Off: mapping goes on as soon as a frame
  /// stands on the map.
  void set_localizing(bool on) { localizing_ = on; }
  [[nodiscard]] bool localizing() const { return localizing_; }

  /// The keyframe that the last call of track() put into the map, for the mapper; invalid when there is none
  /// or it was taken before.
  [[nodiscard]] KeyFrameId take_keyframe();

  /// How the camera is expected to move in dt_s after the last frame (later_from_earlier; dt_s may be
  /// negative): identity while its velocity is unknown.
  [[nodiscard]] SE3 expected_motion(double dt_s) const;

  /// Of each keypoint of the last frame with a pose: whether it holds a map point. Empty when the latest
  /// frame got none.
  [[nodiscard]] std::vector<bool> tracked_keypoints() const;

  /// Map points that the latest frame's pose stands on, as its matches saw them. Empty when it got none.
  [[nodiscard]] std::vector<WorldPoint> tracked_points() const;

  /// Number of the map that the latest frame with a pose of its own is in; 0 before the first.
  [[nodiscard]] int session() const;

  [[nodiscard]] Trajectory trajectory() const { return trajectory_.resolve(map_); }
  /// Of this run and of those that the loaded map is from.
  [[nodiscard]] const std::vector<LoggedFrame>& logged_frames() const { return trajectory_.frames(); }

 private:
  bool initialize(Frame& frame);
  [[nodiscard]] bool could_begin_map(const Frame& frame) const;
  /// Begins another map when the camera has been lost in a new place for long enough.
  bool begin_another_map(Frame& frame);
  bool place(Frame& frame);
  [[nodiscard]] bool has_last() const { return last_.features != nullptr; }
  /// Brings the last frame up to date with the map; returns the map's count of corrections.
  std::uint64_t refresh_last();
  [[nodiscard]] std::uint64_t present_corrections() const;
  [[nodiscard]] int session_of(KeyFrameId keyframe) const;
  void update_velocity(const Frame& frame);
  void count_visible(const Frame& frame);
  bool should_insert(const Frame& frame, MapperLoad load) const;
  void insert(Frame& frame);
  void finish_tracked(Frame frame, TrackResult& result);
  void finish_untracked(const Frame& frame, TrackResult& result);
  [[nodiscard]] SE3 predicted_pose(double time_s) const;

  const Rig& rig_;
  Map& map_;
  StageTimer& timer_;
  Log log_;

  TrackingState state_ = TrackingState::kNotInitialized;  // kTracked for weak poses, too
  bool localizing_;
  FramePlacer placer_;
  Placement placement_;        // of the frame at hand
  int last_inliers_ = 0;       // of last_
  int best_inliers_ = 0;       // of the frames since the last keyframe
  Frame last_;                 // the latest frame with a pose of its own
  KeyFrameId last_reference_;  // keyframe that last_'s pose hangs on
  SE3 last_from_reference_;
  SE3 velocity_;  // last_from_previous, for velocity_interval_s_
  double velocity_interval_s_ = 0.0;
  KeyFrameId new_keyframe_;
  std::uint64_t n_frames_ = 0;
  std::size_t frames_without_pose_ = 0;
  TrajectoryLog trajectory_;
  NewMapDecision new_map_;
};

}  // namespace cpslam
