#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "cpslam/dense_map.h"
#include "cpslam/log.h"
#include "cpslam/person_detector.h"
#include "cpslam/rgbd_frame.h"
#include "cpslam/settings.h"
#include "cpslam/types.h"

namespace cpslam {

class SnapshotBoard;

/// RGB-D SLAM: feed frames in the order of their stamps, read poses.
///
/// Several Systems may live in one process. Members may be called from one thread at a time. The destructor
/// stops and joins every thread.
class System {
 public:
  /// Uses the detector that settings.detector asks for. Throws InputError when a setting is missing or out of
  /// range, or the vocabulary, the map to load or a file of the detector's is missing or broken, or that map
  /// was made with another camera. In a loaded map frames have no pose (TrackingState::kLost) until one is
  /// recognised in it; from then on poses are those in the map's world.
  explicit System(const Settings& settings, LogSink log = {});
  /// The same with a detector of the caller's; null for none.
  System(const Settings& settings, std::unique_ptr<PersonDetector> detector, LogSink log = {});
  ~System();
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  /// Tracks one frame.
  /// colour: CV_8UC3 (B,G,R as OpenCV reads it) or CV_8UC1; depth: CV_16UC1 or
  /// CV_32FC1 in units of depth_map_factor, registered to the colour image, 0 or NaN where there is none;
  /// both of the size in the settings. time_s must grow from call to call. Throws InputError, and leaves the
  /// state as it was, for images or a stamp that are not so; RunError or what the mapping thread threw when
  /// that thread died: the trajectory so far stays readable.
  TrackResult track(const cv::Mat& colour, const cv::Mat& depth, double time_s);

  /// The same for a camera that stamps its depth images apart: the camera's motion between the two exposures
  /// is taken out of the depths. depth_time_s may lie before or after time_s.
  TrackResult track(const cv::Mat& colour, const cv::Mat& depth, double time_s, double depth_time_s);

  /// The same with all that a frame can carry, boxes and masks of the caller's own detector among it.
  TrackResult track(const RgbdFrame& frame);

  /// What was seen in the last frame that track() took, to draw it.
  [[nodiscard]] FrameView frame_view() const;

  /// From now on lays snapshots (cpslam/snapshot.h) down on this board whenever somebody asks for one there,
  /// and the map once more at shutdown(); null: no longer. They change nothing in what is tracked and mapped.
  void publish_to(std::shared_ptr<SnapshotBoard> board);

  /// On: from the next frame on the camera is only found in the map, which does not change any more once the
  /// mapping under way is done; where the map shows nothing, poses are carried on (TrackResult::bridged).
  /// Off: mapping goes on; a camera that is where the map shows nothing has to come back to it first, because
  /// a keyframe out there would hang on a pose that has drifted. Throws InputError for "on" when there is no
  /// map yet.
  void set_localization(bool on);

  /// Drops the map, a loaded one included (its file stays): the next frame starts a new one in a world of its
  /// own. Detector, people, statistics and the board stay; frames tracked so far are in dropped_maps() from
  /// now on and no longer in trajectory(), because the two worlds have nothing to do with each other. There
  /// is no way back. Calls off the mapping under way, and waits for what cannot be: less than a second as a
  /// rule. Does nothing while there is no map. Throws InputError when only localising, and RunError after
  /// shutdown(); the state is then as before.
  void reset();
  /// The oldest first.
  [[nodiscard]] const std::vector<DroppedMap>& dropped_maps() const;

  /// Finishes the mapping of the frames so far and ends the threads. Idempotent; track() may not follow.
  void shutdown();

  /// Writes the map (docs/map-format.md) for Settings::load_map: whole and onto the disk, or not at all, so
  /// that whatever happens the file is the old one or the new one. Any time, also after shutdown(). Throws
  /// RunError that names the file and the cause, also when there is no map yet.
  void save_map(const std::string& path) const;

  /// Pose of every tracked frame, with all later corrections of its reference keyframe; those in different
  /// maps (StampedPose::map) say nothing about each other.
  [[nodiscard]] Trajectory trajectory() const;
  /// Poses of the keyframes alive that were made here, not of those of a loaded map, by time.
  [[nodiscard]] Trajectory keyframe_trajectory() const;
  [[nodiscard]] Statistics statistics() const;

  /// What the keyframes saw of the room, without its people, at the keyframes' present poses: after
  /// shutdown(), the final ones. Of several maps, that with most frames. Takes seconds. Throws InputError
  /// without settings.dense.enabled or for options out of range.
  [[nodiscard]] DenseMap dense_map(const DenseMapOptions& options = {}) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cpslam
