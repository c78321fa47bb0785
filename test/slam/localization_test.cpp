// System::set_localization(): mapping is switched off and on while the camera runs.
#include <gtest/gtest.h>

#include <algorithm>

#include "cpslam/error.h"
#include "io/temporary_folder.h"
#include "map/map_file.h"
#include "slam/simulated_frames.h"
#include "support/same_trajectory.h"

namespace cpslam {
namespace {

using test::expect_same;
using test::SimulatedFrames;

class SwitchedLocalization : public testing::Test {
 protected:
  /// The bytes of the map without the frames that hang on it: they become more in any case.
  [[nodiscard]] std::string bytes_of_map(const System& system, const Settings& settings) const {
    const std::string path = folder_.file("now.map");
    system.save_map(path);
    MapFile map = load_map_file(path, settings.camera, settings.orb);
    for (MapParts& session : map.sessions) session.frames.clear();
    return to_bytes(map);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(SwitchedLocalization, LeavesTheMapAsItIsUntilMappingGoesOn) {
  const SimulatedFrames frames(60, "office_rpy");
  const Settings settings = frames.with_mode(true);
  System system(settings);
  for (std::size_t i = 0; i < 20; ++i) frames.track(system, i);
  system.set_localization(true);
  const std::string before = bytes_of_map(system, settings);
  for (std::size_t i = 20; i < 40; ++i) {
    const TrackResult result = frames.track(system, i);
    EXPECT_TRUE(is_tracked(result.state)) << i;
    EXPECT_FALSE(result.keyframe) << i;
  }
  EXPECT_TRUE(bytes_of_map(system, settings) == before);
  const std::size_t keyframes = system.statistics().keyframes_created;
  system.set_localization(false);
  for (std::size_t i = 40; i < 60; ++i) frames.track(system, i);
  EXPECT_FALSE(bytes_of_map(system, settings) == before);
  EXPECT_GT(system.statistics().keyframes_created, keyframes);
  EXPECT_EQ(system.trajectory().size(), 60U) << "frames that were only localised are in it";
}

TEST_F(SwitchedLocalization, WithThreadsTheMapStandsStillOnceTheMappingUnderWayIsDone) {
  const SimulatedFrames frames(60, "office_rpy");
  const Settings settings = frames.with_mode(false);
  System system(settings);
  for (std::size_t i = 0; i < 20; ++i) frames.track(system, i);
  system.set_localization(true);
  // Offline, tracking lets the mapper finish after a few frames.
  for (std::size_t i = 20; i < 25; ++i) frames.track(system, i);
  const std::string before = bytes_of_map(system, settings);
  for (std::size_t i = 25; i < 40; ++i) EXPECT_FALSE(frames.track(system, i).keyframe) << i;
  EXPECT_TRUE(bytes_of_map(system, settings) == before);
  system.set_localization(false);
  for (std::size_t i = 40; i < 60; ++i) frames.track(system, i);
  system.shutdown();
  EXPECT_FALSE(bytes_of_map(system, settings) == before);
}

TEST_F(SwitchedLocalization, OnAndOffBetweenTwoFramesChangesNothing) {
  const SimulatedFrames frames(20);
  System switched(frames.with_mode(true));
  System left_alone(frames.with_mode(true));
  for (std::size_t i = 0; i < 20; ++i) {
    frames.track(switched, i);
    frames.track(left_alone, i);
    switched.set_localization(true);
    switched.set_localization(false);
  }
  expect_same(switched.trajectory(), left_alone.trajectory());
  expect_same(switched.keyframe_trajectory(), left_alone.keyframe_trajectory());
}

TEST_F(SwitchedLocalization, WithoutAMapThereIsNothingToLocaliseIn) {
  const SimulatedFrames frames(1);
  System system(frames.with_mode(true));
  EXPECT_THROW(system.set_localization(true), InputError);
  system.set_localization(false);
  EXPECT_TRUE(frames.track(system, 0).keyframe) << "the map starts all the same";
  system.set_localization(true);
}

}  // namespace
}  // namespace cpslam
