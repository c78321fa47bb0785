// Tracking in a map that is bent under its feet.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

#include "io/trajectory_error.h"
#include "slam/frame_input.h"
#include "slam/map_correction.h"
#include "slam/simulated_frames.h"
#include "slam/tracking.h"

namespace cpslam {
namespace {

constexpr std::size_t kFrames = 30;
const SE3 kMove(so3_exp({0.05, 0.2, -0.1}), {0.4, -0.2, 0.3});  // world_new_from_world_old

void move_map(Map& map, const SE3& new_from_old) {
  const std::unique_lock lock(map.mutex());
  MapCorrection correction;
  for (const KeyFrameId id : map.keyframes_by_sequence()) {
    correction.cam_from_world[id] = map.keyframe(id)->cam_from_world * new_from_old.inverse();
  }
  apply_correction(map, correction);
}

/// Tracks all frames; `between` is called before each of them.
Trajectory track(const test::SimulatedFrames& frames, const std::function<void(Map&, std::size_t)>& between) {
  const Rig rig(frames.with_mode(true));
  Map map(rig.pyramid);
  StageTimer timer;
  Tracking tracking(rig, map, nullptr, timer, Log());
  FrameFeaturesBuilder features(rig.settings.camera, rig.settings.orb);
  for (std::size_t i = 0; i < kFrames; ++i) {
    between(map, i);
    const sim::SimulatedFrame& frame = frames.frames[i];
    const TrackResult result = tracking.track(
        frame.time_s, features.build(to_grey(frame.colour_bgr), frame.depth), MapperLoad::kIdle);
    EXPECT_EQ(result.state, TrackingState::kTracked) << i;
    (void)tracking.take_keyframe();
  }
  return tracking.trajectory();
}

class TrackingCorrection : public testing::Test {
 protected:
  const test::SimulatedFrames frames{static_cast<int>(kFrames)};
  const Trajectory plain = track(frames, [](Map&, std::size_t) {});
};

TEST_F(TrackingCorrection, GoesOnWhereTheMapWasMovedTo) {
  const Trajectory moved = track(frames, [](Map& map, std::size_t i) {
    if (i == 15) move_map(map, kMove);
  });
  ASSERT_EQ(moved.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const SE3 expected = kMove * from_pose(plain[i].world_from_camera);
    const SE3 found = from_pose(moved[i].world_from_camera);
    EXPECT_LT((expected.inverse() * found).log().norm(), 0.01) << i;
  }
}

TEST_F(TrackingCorrection, MovesWhileFramesArePlacedLeaveNoTrace) {
  // One move a frame, there and back in turn, whenever the other thread gets to it.
  std::atomic<std::size_t> frame = 0;
  std::atomic<Map*> live = nullptr;
  std::jthread mover([&](const std::stop_token& stop) {
    for (std::size_t seen = 0; !stop.stop_requested(); std::this_thread::yield()) {
      const std::size_t now = frame;
      if (now == seen || live == nullptr) continue;
      seen = now;
      move_map(*live, now % 2 == 0 ? kMove : kMove.inverse());
    }
  });
  const Trajectory moved = track(frames, [&](Map& map, std::size_t i) {
    live = &map;
    frame = i;
    if (i + 1 < kFrames) return;
    mover.request_stop();  // the map dies with track()
    mover.join();
  });
  ASSERT_EQ(moved.size(), plain.size());
  const TrajectoryError error = absolute_trajectory_error(plain, moved);
  EXPECT_EQ(error.pairs, plain.size());
  EXPECT_LT(error.max_m, 0.02);
}

}  // namespace
}  // namespace cpslam
