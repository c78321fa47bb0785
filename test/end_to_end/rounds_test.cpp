// A camera that stays in one room must not make the map grow for ever.
#include <gtest/gtest.h>

#include <algorithm>

#include "end_to_end/clip.h"

namespace cpslam::e2e {
namespace {

constexpr int kFrames = 200;
constexpr int kRounds = 10;
// From the fifth round to the tenth.
constexpr double kGrowth = 1.1;
constexpr double kMemoryGrowthMb = 10.0;

struct Round {
  std::size_t keyframes, map_points;
  double resident_mb;
};

TEST(Rounds, MapAndMemoryReachAPlateau) {
  sim::SimulationOptions options;
  options.preset = "office_xyz";
  options.sensor_noise = true;
  options.n_frames = kFrames;
  Clip clip = render_clip(options);
  System system(clip.settings);
  std::vector<Round> rounds;
  double time_s = 0.0;
  for (int i = 0; i < kRounds; ++i) {
    for (const ClipFrame& frame : clip.frames) system.track(frame.colour, frame.depth, time_s += 1.0 / 30.0);
    // Back the way it came, so that the camera never jumps.
    std::reverse(clip.frames.begin(), clip.frames.end());
    const Statistics statistics = system.statistics();
    rounds.push_back({statistics.keyframes, statistics.map_points, resident_memory_mb()});
    RecordProperty("round_" + std::to_string(i), std::to_string(statistics.keyframes) + " keyframes, " +
                                                     std::to_string(statistics.map_points) + " points, " +
                                                     std::to_string(rounds.back().resident_mb) + " MB");
  }
  const Statistics statistics = system.statistics();
  EXPECT_EQ(statistics.frames, static_cast<std::size_t>(kRounds * kFrames));
  EXPECT_EQ(statistics.tracked, statistics.frames);
  EXPECT_EQ(system.trajectory().size(), statistics.frames);
  const Round& half = rounds[kRounds / 2 - 1];
  const Round& end = rounds.back();
  EXPECT_LE(static_cast<double>(end.keyframes), kGrowth * static_cast<double>(half.keyframes));
  EXPECT_LE(static_cast<double>(end.map_points), kGrowth * static_cast<double>(half.map_points));
  EXPECT_LE(end.resident_mb, half.resident_mb + kMemoryGrowthMb);
}

}  // namespace
}  // namespace cpslam::e2e
