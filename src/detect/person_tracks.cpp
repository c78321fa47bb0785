#include "detect/person_tracks.h"

#include <algorithm>
#include <utility>

#include "detect/camera_motion.h"
#include "detect/moving_blobs.h"
#include "detect/person_carry.h"
#include "detect/person_confirm.h"
#include "detect/person_flow.h"

namespace cpslam {
namespace {

constexpr double kMostImageMotionPx = 40.0;
constexpr double kMotionAsExpectedPx = 1.0;
// Rims that a wrong motion, the shutter and the depth image's own instant let seem to arrive.
constexpr double kMotionPxPerRimCell = 3.0;

/// How far the image of something 2 m away moves, at most.
double image_motion_px(const GridCamera& camera, const SE3& motion) {
  constexpr double kTypicalDepthM = 2.0;
  return camera.camera().fx() *
         (rotation_angle(motion.rotation) + motion.translation.norm() / kTypicalDepthM);
}

}  // namespace

PersonTracks::PersonTracks(const PinholeCamera& camera, std::uint64_t seed)
    : camera_(camera), random_(seed) {}

void PersonTracks::begin_frame(std::uint64_t frame, double time_s, const cv::Mat1f& depth_m,
                               const SE3& this_from_previous) {
  FrameState state;
  state.frame = frame;
  state.time_s = time_s;
  state.depth_m = depth_m;
  state.this_from_previous = this_from_previous;
  frames_.push_back(std::move(state));
  forget_old();
  carry_still_surface(frames_.size() - 1);
  carry_into(frames_.size() - 1);
}

void PersonTracks::set_keypoints(FlowKeypoints keypoints) {
  frames_.back().keypoints = std::move(keypoints);
  measure_motion();
  follow_into(frames_.size() - 1);
}

void PersonTracks::measure_motion() {
  if (frames_.size() < 2) return;
  FrameState& state = frames_.back();
  const FrameState& previous = frames_[frames_.size() - 2];
  const std::optional<SE3> motion =
      measure_camera_motion(camera_, previous.keypoints, paint_people(previous.tracks, camera_.size()),
                            state.keypoints, state.this_from_previous);
  if (!motion) return;
  const SE3 unexpected = *motion * state.this_from_previous.inverse();
  if (image_motion_px(camera_, unexpected) < kMotionAsExpectedPx) return;
  state.this_from_previous = *motion;
  carry_still_surface(frames_.size() - 1);
  carry_into(frames_.size() - 1);
}

void PersonTracks::add_detections(const Detections& detections) {
  const auto found = std::find_if(frames_.begin(), frames_.end(),
                                  [&](const FrameState& state) { return state.frame == detections.frame; });
  if (found == frames_.end()) return;
  found->boxes = detections.boxes;
  std::erase_if(found->boxes, [this](const PersonBox& box) { return cells_of_box(camera_, box).empty(); });
  found->detected = true;
  apply_boxes(*found);
  for (auto i = static_cast<std::size_t>(found - frames_.begin()) + 1; i < frames_.size(); ++i) {
    // Whom the boxes showed was background before.
    settle(i - 1);
    carry_still_surface(i);
    carry_into(i);
    follow_into(i);
    if (frames_[i].detected) apply_boxes(frames_[i]);
  }
}

void PersonTracks::end_frame(const SE3& this_from_previous, bool pose_known) {
  FrameState& state = frames_.back();
  state.this_from_previous = this_from_previous;
  state.pose_known = pose_known;
  carry_still_surface(frames_.size() - 1);
  settle(frames_.size() - 1);
}

void PersonTracks::carry_still_surface(std::size_t index) {
  FrameState& state = frames_[index];
  if (index == 0) {
    state.still = StillSurface::begin(state.depth_m);
  } else {
    state.still = frames_[index - 1].still.carry(camera_, state.depth_m, state.this_from_previous);
  }
}

void PersonTracks::settle(std::size_t index) {
  FrameState& state = frames_[index];
  if (index > 0) drop_what_stays(state.still, state.time_s - frames_[index - 1].time_s, state.tracks);
  const cv::Size size = state.depth_m.size();
  const double motion_px = image_motion_px(camera_, state.this_from_previous);
  // With a wrong motion everything seems to move.
  if (state.pose_known && motion_px < kMostImageMotionPx) {
    const int rim_cells = 1 + static_cast<int>(motion_px / kMotionPxPerRimCell);
    const cv::Mat1b people = paint_people(state.tracks, size);
    add_blobs(state.depth_m, find_moving_blobs(state.depth_m, state.still.age, people, rim_cells),
              state.time_s, state.tracks);
  }
  state.still.claim(paint_people(state.tracks, size));
}

void PersonTracks::carry_into(std::size_t index) {
  FrameState& state = frames_[index];
  state.carried.clear();
  if (index > 0) {
    const FrameState& previous = frames_[index - 1];
    state.carried = previous.tracks;
    carry_people(
        camera_,
        {state.depth_m, state.still, state.this_from_previous, state.time_s, state.time_s - previous.time_s},
        state.carried);
    forget_people(state.time_s, state.still.age, state.carried);
  }
  state.tracks = state.carried;
}

void PersonTracks::follow_into(std::size_t index) {
  if (index == 0) return;
  FrameState& state = frames_[index];
  const FrameState& previous = frames_[index - 1];
  if (previous.tracks.empty()) return;
  follow_keypoints(camera_, previous.keypoints, paint_people(previous.tracks, camera_.size()),
                   state.keypoints, state.this_from_previous, state.time_s - previous.time_s, state.carried);
  state.tracks = state.carried;
}

void PersonTracks::apply_boxes(FrameState& state) {
  state.tracks = state.carried;
  confirm_people(camera_, state.depth_m, state.still, state.time_s, state.boxes, state.keypoints.keypoints,
                 random_, state.tracks);
}

void PersonTracks::forget_old() {
  // One frame more than the limit says, to carry from.
  while (frames_.size() > 2 && frames_.back().time_s - frames_[1].time_s > kHistoryS) frames_.pop_front();
}

}  // namespace cpslam
