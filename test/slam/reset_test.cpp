// System::reset(): the map goes, what was tracked stays.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "cpslam/error.h"
#include "cpslam/snapshot.h"
#include "slam/simulated_frames.h"
#include "support/same_trajectory.h"

namespace cpslam {
namespace {

using test::expect_same;
using test::SimulatedFrames;

Settings with_words(Settings settings) {
  settings.vocabulary = CPSLAM_SOURCE_DIR "/Vocabulary/cpslam.voc";
  return settings;
}

TEST(Reset, AfterItEverythingIsAsInANewSystem) {
  const SimulatedFrames frames(50);
  System reset(with_words(frames.with_mode(true)));
  System fresh(with_words(frames.with_mode(true)));
  for (std::size_t i = 0; i < 25; ++i) frames.track(reset, i);
  const Trajectory before = reset.trajectory();
  const Trajectory keyframes_before = reset.keyframe_trajectory();
  reset.reset();
  EXPECT_TRUE(reset.trajectory().empty());
  EXPECT_TRUE(reset.keyframe_trajectory().empty());
  EXPECT_EQ(reset.statistics().keyframes, 0U);
  EXPECT_EQ(reset.statistics().map_points, 0U);
  for (std::size_t i = 25; i < 50; ++i) {
    const TrackResult result = frames.track(reset, i);
    const TrackResult expected = frames.track(fresh, i);
    ASSERT_EQ(result.state, TrackingState::kTracked) << i;
    EXPECT_EQ(result.n_inliers, expected.n_inliers) << i;
    EXPECT_EQ(result.keyframe, expected.keyframe) << i;
    EXPECT_EQ(result.map, 2) << "another map, another world";
    EXPECT_EQ(expected.map, 1);
  }
  expect_same(reset.trajectory(), fresh.trajectory());
  expect_same(reset.keyframe_trajectory(), fresh.keyframe_trajectory());
  EXPECT_EQ(reset.statistics().map_points, fresh.statistics().map_points);
  ASSERT_EQ(reset.dropped_maps().size(), 1U);
  EXPECT_EQ(before.size(), 25U);
  expect_same(reset.dropped_maps()[0].trajectory, before);
  expect_same(reset.dropped_maps()[0].keyframe_trajectory, keyframes_before);
}

TEST(Reset, CountsGoOnOverAllMaps) {
  const SimulatedFrames frames(30);
  System system(frames.with_mode(true));
  for (std::size_t i = 0; i < 15; ++i) frames.track(system, i);
  const Statistics before = system.statistics();
  system.reset();
  const Statistics after = system.statistics();
  EXPECT_EQ(after.frames, 15U);
  EXPECT_EQ(after.tracked, 15U);
  EXPECT_EQ(after.dropped_maps, 1U);
  EXPECT_EQ(after.keyframes_created, before.keyframes_created);
  EXPECT_EQ(after.map_points_created, before.map_points_created);
  EXPECT_EQ(after.local_bundle_adjustments, before.local_bundle_adjustments);
  for (std::size_t i = 15; i < 30; ++i) frames.track(system, i);
  const Statistics at_end = system.statistics();
  EXPECT_EQ(at_end.frames, 30U);
  EXPECT_EQ(at_end.maps_started, 2U);
  ASSERT_EQ(at_end.maps.size(), 1U);
  EXPECT_EQ(at_end.maps[0].frames, 15U);
  EXPECT_EQ(at_end.keyframes_created, before.keyframes_created + at_end.keyframes);
  EXPECT_EQ(at_end.local_bundle_adjustments, at_end.keyframes_created);
  EXPECT_GT(at_end.map_points_created, before.map_points_created);
}

TEST(Reset, WithoutAMapThereIsNothingToDrop) {
  const SimulatedFrames frames(3);
  System system(frames.with_mode(true));
  system.reset();
  EXPECT_TRUE(system.dropped_maps().empty());
  frames.track(system, 0);
  system.reset();
  system.reset();
  EXPECT_EQ(system.dropped_maps().size(), 1U);
  EXPECT_THROW(frames.track(system, 0), InputError) << "stamps still have to grow";
  EXPECT_EQ(frames.track(system, 1).state, TrackingState::kTracked);
}

TEST(Reset, IsRefusedWhereItMustNotBe) {
  const SimulatedFrames frames(3);
  System system(frames.with_mode(false));
  frames.track(system, 0);
  frames.track(system, 1);
  system.set_localization(true);
  EXPECT_THROW(system.reset(), InputError);
  EXPECT_EQ(system.trajectory().size(), 2U);
  system.set_localization(false);
  system.shutdown();
  EXPECT_THROW(system.reset(), RunError);
  EXPECT_EQ(system.trajectory().size(), 2U);
  EXPECT_TRUE(system.dropped_maps().empty());
}

TEST(Reset, TheBoardShowsTheNewMap) {
  const SimulatedFrames frames(3);
  System system(frames.with_mode(true));
  const auto board = std::make_shared<SnapshotBoard>();
  system.publish_to(board);
  board->request_map(SnapshotWish::kEvery);
  frames.track(system, 0);
  EXPECT_EQ(board->map()->keyframes.size(), 1U);
  system.reset();
  EXPECT_TRUE(board->map()->keyframes.empty());
  EXPECT_TRUE(board->map()->points.empty());
  frames.track(system, 1);
  EXPECT_EQ(board->map()->trajectory.size(), 1U);
}

TEST(Reset, ADroppedMapsPlacesAreNotRecognised) {
  const SimulatedFrames frames(12);
  System system(with_words(frames.with_mode(true)));
  for (std::size_t i = 0; i < 6; ++i) frames.track(system, i);
  system.reset();
  frames.track(system, 6);
  // Where nothing is seen the camera gets lost, and then looks for keyframes that look alike.
  const cv::Mat black = cv::Mat::zeros(frames.frames[7].colour_bgr.size(), CV_8UC3);
  EXPECT_FALSE(is_tracked(system.track(black, frames.frames[7].depth, frames.frames[7].time_s).state));
  for (std::size_t i = 8; i < 12; ++i) EXPECT_TRUE(is_tracked(frames.track(system, i).state)) << i;
  EXPECT_EQ(system.trajectory().size(), 5U);
}

class ResetWithThreads : public testing::TestWithParam<bool> {};

// For ThreadSanitizer, too: the map goes while its threads are at work in it and somebody watches.
TEST_P(ResetWithThreads, InTheMiddleOfTheMappingNothingBreaks) {
  constexpr std::size_t kFrames = 60;
  const SimulatedFrames frames(static_cast<int>(kFrames), "office_rpy");
  Settings settings = with_words(frames.with_mode(false));
  settings.realtime = GetParam();
  System system(settings);
  const auto board = std::make_shared<SnapshotBoard>();
  system.publish_to(board);
  std::atomic<std::size_t> seen = 0;
  std::jthread viewer([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      board->request_frame(SnapshotWish::kEvery);
      board->request_map(SnapshotWish::kEvery);
      if (const auto map = board->map()) seen += map->points.size();
      std::this_thread::yield();
    }
  });
  std::size_t tracked = 0;
  std::size_t due = 10;
  for (std::size_t i = 0; i < kFrames; ++i) {
    const TrackResult result = frames.track(system, i);
    tracked += is_tracked(result.state) ? 1U : 0U;
    // Right behind a keyframe, with which the mapper has only begun; if none comes, some time.
    if ((result.keyframe && i >= due) || i >= due + 15) {
      system.reset();
      due = i + 10;
    }
  }
  viewer.request_stop();
  viewer.join();
  system.shutdown();
  EXPECT_GT(seen, 0U);
  EXPECT_GE(system.dropped_maps().size(), 2U);
  std::size_t kept = system.trajectory().size();
  for (const DroppedMap& map : system.dropped_maps()) {
    EXPECT_FALSE(map.trajectory.empty());
    kept += map.trajectory.size();
  }
  EXPECT_EQ(kept, tracked) << "no frame is lost";
  EXPECT_EQ(tracked, kFrames);
}

INSTANTIATE_TEST_SUITE_P(Paces, ResetWithThreads, testing::Bool(),
                         [](const auto& pace) { return pace.param ? "Realtime" : "Offline"; });

}  // namespace
}  // namespace cpslam
