#pragma once

#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <vector>

#include "detect/detections.h"
#include "detect/grid_camera.h"
#include "detect/keypoint_flow.h"
#include "detect/person_track.h"
#include "detect/still_surface.h"
#include "geometry/se3.h"
#include "util/random.h"

namespace cpslam {

/// What is known of people from frame to frame, detections or not. Every frame goes through:
///  - begin_frame: everybody is carried into the new depths; labels() is a prediction good for the extractor;
///  - set_keypoints: their flow corrects the camera's motion (measure_camera_motion), and the velocities;
///  - add_detections: boxes of this frame or of an earlier one, then time is wound back to it and played
///  again;
///  - end_frame: the camera's motion as it was found in the end; it shows what else moves.
/// One thread.
class PersonTracks {
 public:
  PersonTracks(const PinholeCamera& camera, std::uint64_t seed);

  /// depth_m: reduce_depth of the frame's depth image, not to be changed any more. this_from_previous: how
  /// the camera is expected to have moved since the last frame.
  void begin_frame(std::uint64_t frame, double time_s, const cv::Mat1f& depth_m,
                   const SE3& this_from_previous);
  void set_keypoints(FlowKeypoints keypoints);
  /// Ignored when the frame is further back than kHistoryS or came before the first; so are boxes that cover
  /// nothing of the image, or are none (a size not above zero, a number not finite).
  void add_detections(const Detections& detections);
  /// pose_known: else the motion is only what was expected.
  void end_frame(const SE3& this_from_previous, bool pose_known);

  [[nodiscard]] const std::vector<PersonTrack>& tracks() const { return frames_.back().tracks; }
  /// The number of the person at each cell of the grid, 0 where there is none.
  [[nodiscard]] cv::Mat1b labels() const { return paint_people(tracks(), camera_.size()); }
  [[nodiscard]] const cv::Mat1f& depth_m() const { return frames_.back().depth_m; }
  [[nodiscard]] const StillSurface& still() const { return frames_.back().still; }
  [[nodiscard]] const GridCamera& camera() const { return camera_; }

  /// Boxes that come later than this after their image are of no use.
  static constexpr double kHistoryS = 2.0;

 private:
  struct FrameState {
    std::uint64_t frame = 0;
    double time_s = 0.0;
    cv::Mat1f depth_m;
    StillSurface still;
    SE3 this_from_previous;
    FlowKeypoints keypoints;
    std::vector<PersonBox> boxes;
    bool detected = false;  // boxes are this frame's
    bool pose_known = false;
    std::vector<PersonTrack> carried;  // before its boxes
    std::vector<PersonTrack> tracks;   // after
  };
  /// Corrects the motion of the newest frame by its keypoints.
  void measure_motion();
  void carry_into(std::size_t index);
  void follow_into(std::size_t index);
  void apply_boxes(FrameState& state);
  void carry_still_surface(std::size_t index);
  void settle(std::size_t index);
  void forget_old();

  GridCamera camera_;
  Random random_;
  std::deque<FrameState> frames_;  // oldest first, the current one last
};

}  // namespace cpslam
