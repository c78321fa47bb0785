#include "cpslam/system.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <opencv2/imgproc.hpp>

#include "cpslam/error.h"
#include "geometry/se3.h"
#include "slam/simulated_frames.h"
#include "support/same_trajectory.h"

namespace cpslam {
namespace {

using test::expect_same;
using test::SimulatedFrames;

/// How far the two frames' motion from the first one on lies from the truth, m and rad together.
double drift(const SimulatedFrames& frames, const TrackResult& first, std::size_t i_first,
             const TrackResult& later, std::size_t i_later) {
  const SE3 truth =
      frames.frames[i_first].world_from_camera.inverse() * frames.frames[i_later].world_from_camera;
  const SE3 found = from_pose(first.world_from_camera).inverse() * from_pose(later.world_from_camera);
  return (truth.inverse() * found).log().norm();
}

TEST(SystemTest, TracksEveryFrameNearTheTruth) {
  const SimulatedFrames frames(60);
  System system(frames.with_mode(false));
  TrackResult first;
  for (std::size_t i = 0; i < 60; ++i) {
    const TrackResult result = frames.track(system, i);
    if (i == 0) first = result;
    ASSERT_EQ(result.state, TrackingState::kTracked) << i;
    EXPECT_EQ(result.time_s, frames.frames[i].time_s);
    EXPECT_GE(result.n_inliers, frames.settings.tracking.min_inliers);
    EXPECT_LT(drift(frames, first, 0, result, i), 0.05) << i;
  }
  system.shutdown();
  EXPECT_EQ(system.trajectory().size(), 60U);
  const Statistics statistics = system.statistics();
  EXPECT_EQ(statistics.frames, 60U);
  EXPECT_EQ(statistics.tracked, 60U);
  EXPECT_GT(statistics.keyframes, 1U);
  EXPECT_EQ(system.keyframe_trajectory().size(), statistics.keyframes);
  EXPECT_GE(statistics.keyframes_created, statistics.keyframes);
  EXPECT_GE(statistics.map_points_created, statistics.map_points);
  EXPECT_EQ(statistics.local_bundle_adjustments, statistics.keyframes_created);
}

TEST(SystemTest, SequentialRunsAreEqualBitByBitEvenSideBySide) {
  const SimulatedFrames frames(60);
  System alone(frames.with_mode(true));
  for (std::size_t i = 0; i < 60; ++i) frames.track(alone, i);
  // Two at once, one of them a few frames ahead: they share nothing.
  System ahead(frames.with_mode(true));
  System behind(frames.with_mode(true));
  for (std::size_t i = 0; i < 65; ++i) {
    if (i < 60) frames.track(ahead, i);
    if (i >= 5) frames.track(behind, i - 5);
  }
  expect_same(alone.trajectory(), ahead.trajectory());
  expect_same(alone.trajectory(), behind.trajectory());
  expect_same(alone.keyframe_trajectory(), behind.keyframe_trajectory());
  EXPECT_EQ(alone.trajectory().size(), 60U);
}

TEST(SystemTest, BadInputIsRefusedAndLeavesTheStateAsItWas) {
  const SimulatedFrames frames(8);
  System clean(frames.with_mode(true));
  System bothered(frames.with_mode(true));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < 8; ++i) {
    const cv::Mat& colour = frames.frames[i].colour_bgr;
    const cv::Mat& depth = frames.frames[i].depth;
    const double time_s = frames.frames[i].time_s;
    EXPECT_THROW(bothered.track({}, depth, time_s), InputError);
    EXPECT_THROW(bothered.track(colour, {}, time_s), InputError);
    EXPECT_THROW(bothered.track(depth, depth, time_s), InputError);
    EXPECT_THROW(bothered.track(colour, colour, time_s), InputError);
    const cv::Rect part(0, 0, 100, 100);
    EXPECT_THROW(bothered.track(colour(part), depth(part), time_s), InputError);
    EXPECT_THROW(bothered.track(colour, depth(part), time_s), InputError);
    EXPECT_THROW(bothered.track(colour, depth, nan), InputError);
    EXPECT_THROW(bothered.track(colour, depth, std::numeric_limits<double>::infinity()), InputError);
    EXPECT_THROW(bothered.track(colour, depth, time_s, nan), InputError);
    if (i > 0) {
      EXPECT_THROW(bothered.track(colour, depth, frames.frames[i - 1].time_s), InputError)
          << "the same stamp again";
      EXPECT_THROW(bothered.track(colour, depth, time_s - 1.0), InputError);
    }
    frames.track(clean, i);
    EXPECT_EQ(frames.track(bothered, i).state, TrackingState::kTracked);
  }
  expect_same(clean.trajectory(), bothered.trajectory());
  EXPECT_EQ(bothered.statistics().frames, 8U);
}

TEST(SystemTest, SettingsAreChecked) {
  EXPECT_THROW(System{Settings{}}, InputError) << "no focal length";
}

TEST(SystemTest, GreyAndFloatImagesGiveTheSameResult) {
  const SimulatedFrames frames(5);
  System colour(frames.with_mode(true));
  System grey(frames.with_mode(true));
  for (std::size_t i = 0; i < 5; ++i) {
    frames.track(colour, i);
    cv::Mat luminance;
    cv::cvtColor(frames.frames[i].colour_bgr, luminance, cv::COLOR_BGR2GRAY);
    cv::Mat depth;
    frames.frames[i].depth.convertTo(depth, CV_32F);
    grey.track(luminance, depth, frames.frames[i].time_s);
  }
  expect_same(colour.trajectory(), grey.trajectory());
}

class SystemOutage : public testing::TestWithParam<bool> {};

TEST_P(SystemOutage, ASecondOfBlackImagesIsSurvived) {
  const bool depth_only = GetParam();
  const SimulatedFrames frames(45, "office_static");
  System system(frames.with_mode(false));
  TrackResult first;
  TrackResult last;
  std::size_t tracked = 0;
  for (std::size_t i = 0; i < 45; ++i) {
    const bool outage = i >= 10 && i < 40;
    const sim::SimulatedFrame& frame = frames.frames[i];
    const cv::Mat no_depth = cv::Mat::zeros(frame.depth.size(), frame.depth.type());
    const cv::Mat black = cv::Mat::zeros(frame.colour_bgr.size(), frame.colour_bgr.type());
    last = system.track(outage && !depth_only ? black : frame.colour_bgr, outage ? no_depth : frame.depth,
                        frame.time_s);
    if (i == 0) first = last;
    if (!outage) {
      EXPECT_TRUE(is_tracked(last.state)) << i;
    } else if (!depth_only) {
      EXPECT_FALSE(is_tracked(last.state)) << i;
      EXPECT_EQ(last.n_inliers, 0);
    }
    tracked += is_tracked(last.state) ? 1U : 0U;
  }
  EXPECT_LT(drift(frames, first, 0, last, 44), 0.03);
  system.shutdown();
  EXPECT_EQ(system.trajectory().size(), tracked) << "only tracked frames are written";
  const Statistics statistics = system.statistics();
  EXPECT_EQ(statistics.frames, 45U);
  EXPECT_EQ(statistics.tracked, tracked);
  EXPECT_EQ(statistics.tracked + statistics.predicted + statistics.lost, 45U);
  if (!depth_only) {
    EXPECT_GT(statistics.predicted, 5U);
    EXPECT_GT(statistics.lost, 10U);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SystemOutage, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "NoDepth" : "BlackWithoutDepth"; });

TEST(SystemTest, FramesWithoutDepthStartNoMap) {
  const SimulatedFrames frames(4);
  std::mutex mutex;
  std::string warnings;
  System system(frames.with_mode(false), [&](LogLevel level, const std::string& message) {
    const std::lock_guard lock(mutex);
    if (level == LogLevel::kWarning) warnings += message;
  });
  const cv::Mat no_depth = cv::Mat::zeros(frames.frames[0].depth.size(), CV_16UC1);
  for (std::size_t i = 0; i < 2; ++i) {
    const TrackResult result = system.track(frames.frames[i].colour_bgr, no_depth, frames.frames[i].time_s);
    EXPECT_EQ(result.state, TrackingState::kNotInitialized);
    EXPECT_GT(result.n_keypoints, 100);
  }
  EXPECT_EQ(system.statistics().keyframes, 0U);
  EXPECT_TRUE(system.trajectory().empty());
  const TrackResult start = frames.track(system, 2);
  EXPECT_EQ(start.state, TrackingState::kTracked);
  EXPECT_TRUE(start.keyframe);
  EXPECT_EQ(frames.track(system, 3).state, TrackingState::kTracked);
  EXPECT_EQ(system.statistics().not_initialized, 2U);
  EXPECT_EQ(system.trajectory().front().time_s, frames.frames[2].time_s);
  EXPECT_THAT(warnings, testing::HasSubstr("no valid reading"));
}

TEST(SystemTest, ShutdownIsFinalAndIdempotent) {
  const SimulatedFrames frames(3);
  System system(frames.with_mode(false));
  frames.track(system, 0);
  frames.track(system, 1);
  system.shutdown();
  system.shutdown();
  EXPECT_THROW(frames.track(system, 2), RunError);
  EXPECT_EQ(system.trajectory().size(), 2U);
  EXPECT_EQ(system.statistics().frames, 2U);
}

TEST(SystemTest, DestructorNeedsNoShutdown) {
  const SimulatedFrames frames(3);
  for (int run = 0; run < 3; ++run) {
    System system(frames.with_mode(false));
    for (std::size_t i = 0; i < 3; ++i) frames.track(system, i);
  }
  const System unused(frames.with_mode(false));
}

/// Mean drift when each colour image comes with the depth of a tenth of a second later.
double drift_with_late_depth(const SimulatedFrames& frames, bool say_so) {
  constexpr std::size_t kLate = 3;
  constexpr std::size_t kWarm = 5;
  System system(frames.with_mode(true));
  TrackResult first;
  double sum = 0.0;
  const std::size_t n = frames.frames.size() - kLate;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& frame = frames.frames[i];
    // Till the velocity is known there is nothing to correct with: these come with their own depth.
    const auto& later = frames.frames[i < kWarm ? i : i + kLate];
    const double depth_time_s = say_so ? later.time_s : frame.time_s;
    const TrackResult result = system.track(frame.colour_bgr, later.depth, frame.time_s, depth_time_s);
    EXPECT_EQ(result.state, TrackingState::kTracked) << i;
    if (i == kWarm) first = result;
    if (i > kWarm) sum += drift(frames, first, kWarm, result, i);
  }
  return sum / static_cast<double>(n - kWarm - 1);
}

TEST(SystemTest, DepthStampedApartIsBroughtBackToTheColourImage) {
  const SimulatedFrames frames(60, "office_rpy");
  const double told = drift_with_late_depth(frames, true);
  const double untold = drift_with_late_depth(frames, false);
  EXPECT_LT(told, 0.8 * untold);
}

}  // namespace
}  // namespace cpslam
