// A walk that comes back to where it began, and one past two desks that look the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "end_to_end/clip.h"
#include "geometry/se3.h"
#include "io/trajectory_error.h"
#include "support/half_size.h"

namespace cpslam::e2e {
namespace {

/// A third of the frames at a quarter of the pixels: what is tested is what comes after tracking.
Clip render_small(const std::string& preset, double seconds) {
  constexpr double kFps = 10.0;
  sim::SimulationOptions options;
  options.preset = preset;
  options.seed = 1;
  options.sensor_noise = true;
  options.n_frames = static_cast<int>(seconds * kFps);
  options.camera.fps = kFps;
  test::halve(options.camera);
  Clip clip = render_clip(options);
  clip.settings.vocabulary = CPSLAM_SOURCE_DIR "/Vocabulary/cpslam.voc";
  return clip;
}

struct Outcome {
  Statistics statistics;
  Trajectory trajectory;
  double ate_m = 0.0;
};

Outcome run(const Clip& clip, bool loops, bool sequential = true) {
  Settings settings = clip.settings;
  settings.loops.enabled = loops;
  settings.sequential = sequential;
  System system(settings);
  (void)track_all(system, clip);
  system.shutdown();
  Outcome result{system.statistics(), system.trajectory(), 0.0};
  result.ate_m = absolute_trajectory_error(clip.truth(), result.trajectory).rmse_m;
  return result;
}

SE3 truth_at(const Clip& clip, double time_s) {
  const auto nearest =
      std::min_element(clip.frames.begin(), clip.frames.end(), [&](const ClipFrame& a, const ClipFrame& b) {
        return std::abs(a.time_s - time_s) < std::abs(b.time_s - time_s);
      });
  return from_pose(nearest->world_from_camera);
}

/// Both ends of every loop must really have looked at the same thing from near by.
void expect_true_loops(const Clip& clip, const Statistics& statistics) {
  for (const LoopEvent& event : statistics.loops.events) {
    const SE3 apart = truth_at(clip, event.matched_time_s).inverse() * truth_at(clip, event.time_s);
    EXPECT_LT(apart.translation.norm(), 2.0) << event.time_s << " and " << event.matched_time_s;
    EXPECT_LT(rotation_angle(apart.rotation), 0.3 * std::numbers::pi)
        << event.time_s << " and " << event.matched_time_s;
  }
}

TEST(Loops, ARingOfRoomsIsClosed) {
  const Clip clip = render_small("ring", 47.0);
  const Outcome without = run(clip, false);
  EXPECT_TRUE(without.statistics.loops.events.empty());
  const Outcome with = run(clip, true);
  EXPECT_EQ(with.statistics.tracked, clip.frames.size());
  ASSERT_GE(with.statistics.loops.events.size(), 1U);
  expect_true_loops(clip, with.statistics);
  EXPECT_GE(with.statistics.loops.full_bundle_adjustments, 1U);
  EXPECT_LT(with.ate_m, 0.6 * without.ate_m) << with.ate_m << " of " << without.ate_m;
  EXPECT_LT(with.ate_m, 0.07);
  RecordProperty("ate_m",
                 std::to_string(with.ate_m) + " with loops, " + std::to_string(without.ate_m) + " without");

  const Outcome again = run(clip, true);
  ASSERT_EQ(again.trajectory.size(), with.trajectory.size());
  for (std::size_t i = 0; i < again.trajectory.size(); ++i) {
    ASSERT_EQ(again.trajectory[i].world_from_camera.translation_m,
              with.trajectory[i].world_from_camera.translation_m)
        << i;
    ASSERT_EQ(again.trajectory[i].world_from_camera.rotation_xyzw,
              with.trajectory[i].world_from_camera.rotation_xyzw)
        << i;
  }

  const Outcome threaded = run(clip, true, false);
  EXPECT_EQ(threaded.statistics.tracked, clip.frames.size());
  ASSERT_GE(threaded.statistics.loops.events.size(), 1U);
  expect_true_loops(clip, threaded.statistics);
  EXPECT_LT(threaded.ate_m, 0.07);
}

TEST(Loops, TwoIdenticalDesksAreToldApart) {
  const Clip clip = render_small("twin_desks", 24.0);
  const Outcome with = run(clip, true);
  EXPECT_EQ(with.statistics.tracked, clip.frames.size());
  expect_true_loops(clip, with.statistics);
  EXPECT_LT(with.ate_m, 0.05);
}

}  // namespace
}  // namespace cpslam::e2e
