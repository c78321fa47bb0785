#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "camera/pinhole_camera.h"
#include "cpslam/rgbd_frame.h"
#include "cpslam/settings.h"
#include "cpslam/snapshot.h"
#include "cpslam/types.h"
#include "detect/detector_thread.h"
#include "detect/person_tracks.h"
#include "features/frame_features.h"
#include "geometry/se3.h"
#include "util/log.h"
#include "util/random.h"
#include "util/stage_timer.h"

namespace cpslam {

/// Keeps people out of the map: the detector, what is known of people, and the decision which keypoints of a
/// frame are theirs. A frame goes through begin(), prior() for the extractor, filter() once or, after the
/// candidates were extended, again, and end(). One thread.
class People {
 public:
  /// detector: null for none; then there are only people in frames whose boxes or mask the caller brings.
  People(const Settings& settings, std::unique_ptr<PersonDetector> detector, StageTimer& timer, Log log);

  /// Throws InputError for a moving_mask of another type or size than the settings say.
  void check(const RgbdFrame& frame) const;

  /// Offers the image to the detector and carries the people of earlier frames into this one.
  /// expected_motion: this_from_previous of the camera. The images must not be written to before end().
  void begin(const RgbdFrame& frame, const SE3& expected_motion);
  /// Where people are expected, before this frame was looked at.
  [[nodiscard]] ExtractionPrior prior() const;
  /// Which candidates to keep (1) and which are on people (0). Waits for this frame's boxes if the policy
  /// says so.
  [[nodiscard]] std::vector<std::uint8_t> filter(const KeypointCandidates& candidates);
  /// How many more keypoints the frame should get outside people, when the filter left few; 0: enough.
  [[nodiscard]] int missing_keypoints(const std::vector<std::uint8_t>& keep);
  /// Where the people are now, as a mask for FrameFeaturesBuilder::extend.
  [[nodiscard]] cv::Mat excluded() const;
  /// All of the depth image that may move by itself, as far as is known after end(): people and whatever else
  /// is in their boxes, which surface is theirs being uncertain at first, other movers, and the caller's
  /// mask. CV_8UC1 of the images' size, 0 nothing; empty when nobody is looked for.
  [[nodiscard]] cv::Mat moving() const;
  /// motion: as it was found in the end; pose_known: or only expected.
  void end(const SE3& motion, bool pose_known);

  /// No more frames: see DetectorThread::finish().
  void finish();

  /// Boxes and mask of the last frame.
  void show(FrameView& view) const;
  /// Where the people of the last frame are, for a viewer. Nobody but with PeopleFilter::kSdf.
  [[nodiscard]] std::vector<PersonShape> shapes(const SE3& world_from_camera) const;
  [[nodiscard]] PeopleStatistics statistics() const;

 private:
  void take(Detections detections);
  void collect_boxes();
  [[nodiscard]] bool uses_tracks() const { return settings_.people.filter == PeopleFilter::kSdf; }
  [[nodiscard]] std::vector<std::uint8_t> judge(const std::vector<DepthKeypoint>& keypoints);
  void reinstate(const std::vector<DepthKeypoint>& keypoints, std::vector<std::uint8_t>& marks);
  void add_moving_mask(const std::vector<DepthKeypoint>& keypoints, std::vector<std::uint8_t>& marks) const;

  const Settings settings_;
  const double metres_per_unit_;
  StageTimer& timer_;
  const Log log_;
  PersonTracks tracks_;
  Random random_;
  std::unique_ptr<DetectorThread> detector_;
  bool active_;
  // of the frame at hand
  std::uint64_t frame_ = 0;
  double time_s_ = 0.0;
  double depth_lag_s_ = 0.0;
  cv::Mat depth_;
  cv::Mat moving_mask_;
  bool boxes_collected_ = false;
  // the newest boxes
  std::vector<PersonBox> boxes_;
  std::optional<double> boxes_time_s_;
  // statistics
  PeopleStatistics counts_;
  std::size_t n_callers_boxes_ = 0;
  std::size_t last_candidates_ = 0, last_removed_ = 0, last_reinstated_ = 0;
  std::size_t frames_with_boxes_ = 0;
  double boxes_age_sum_s_ = 0.0;
};

}  // namespace cpslam
