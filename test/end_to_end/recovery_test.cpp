// Tracking comes back where the camera sees a known place again.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "end_to_end/clip.h"
#include "geometry/se3.h"

namespace cpslam::e2e {
namespace {

constexpr double kLargestErrorM = 0.03;
// Where a place is wrong it is wrong by decimetres; the very frame of a jump may be a little less exact than
// others.
constexpr double kSamePlaceM = 0.05;
constexpr std::size_t kSoon = 10;  // frames

class Recovery : public testing::Test {
 protected:
  static Clip office(const std::string& preset, int n_frames) {
    sim::SimulationOptions options;
    options.preset = preset;
    options.sensor_noise = true;
    options.n_frames = n_frames;
    return render_clip(options);
  }
  /// Expects that from some frame on, soon after `from`, all are tracked, and that no tracked frame is
  /// anywhere else than where the camera was.
  static void expect_back_soon_after(std::size_t from, const std::vector<TrackResult>& results,
                                     const Clip& clip, double largest_error_m = kLargestErrorM) {
    const auto tracked = [](const TrackResult& result) { return is_tracked(result.state); };
    const auto begin = results.begin() + static_cast<std::ptrdiff_t>(from);
    const auto back = std::find_if(begin, results.end(), tracked);
    EXPECT_LE(back - begin, static_cast<std::ptrdiff_t>(kSoon));
    EXPECT_TRUE(std::all_of(back, results.end(), tracked));
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (!tracked(results[i])) continue;
      EXPECT_LT(position_error_m(results[i], clip.frames[i], clip.frames[0]), largest_error_m)
          << "frame " << i;
    }
    RecordProperty("frames_without_pose", static_cast<int>(back - begin));
  }
};

TEST_F(Recovery, CoveredLens) {
  constexpr std::size_t kCovered = 60, kUncovered = 80;
  Clip clip = office("office_xyz", 120);
  for (std::size_t i = kCovered; i < kUncovered; ++i)
    clip.frames[i].colour = cv::Mat::zeros(clip.frames[i].colour.size(), CV_8UC3);
  System system(clip.settings);
  const std::vector<TrackResult> results = track_all(system, clip);
  for (std::size_t i = kCovered; i < kUncovered; ++i)
    EXPECT_FALSE(is_tracked(results[i].state)) << "frame " << i << " shows nothing";
  EXPECT_EQ(results[kUncovered - 1].state, TrackingState::kLost);
  expect_back_soon_after(kUncovered, results, clip);
}

TEST_F(Recovery, KidnappedToAKnownPlace) {
  // Far enough that the search around the predicted pose cannot find it.
  constexpr std::size_t kJump = 150, kBack = 100, kAfter = 30;
  Clip clip = office("office_halfsphere", static_cast<int>(kJump));
  for (std::size_t i = 0; i < kAfter; ++i) {
    ClipFrame again = clip.frames[kJump - kBack + i];
    again.time_s = clip.frames.back().time_s + 1.0 / 30.0;
    clip.frames.push_back(again);
  }
  const double jump_m = (from_pose(clip.frames[kJump].world_from_camera).translation -
                         from_pose(clip.frames[kJump - 1].world_from_camera).translation)
                            .norm();
  RecordProperty("jump_m", std::to_string(jump_m));
  ASSERT_GT(jump_m, 0.5);
  System system(clip.settings);
  expect_back_soon_after(kJump, track_all(system, clip), clip);
}

TEST_F(Recovery, KidnappedAnywhereNeverToAWrongPlace) {
  // Jumps of 0.4 to 0.9 m between views of like furniture: a few dozen points agree with a wrong pose there.
  for (const char* preset : {"office_halfsphere", "office_xyz"}) {
    const Clip whole = office(preset, 150);
    for (const std::size_t to : {30U, 70U, 90U, 110U}) {
      SCOPED_TRACE(std::string(preset) + " to " + std::to_string(to));
      Clip clip = whole;
      for (std::size_t i = 0; i < 20; ++i) {
        ClipFrame again = clip.frames[to + i];
        again.time_s = clip.frames.back().time_s + 1.0 / 30.0;
        clip.frames.push_back(again);
      }
      System system(clip.settings);
      expect_back_soon_after(150, track_all(system, clip), clip, kSamePlaceM);
    }
  }
}

}  // namespace
}  // namespace cpslam::e2e
