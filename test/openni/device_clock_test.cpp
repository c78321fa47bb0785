#include "openni/device_clock.h"

#include <gtest/gtest.h>

#include <cmath>

#include "openni/camera_frames.h"
#include "util/random.h"

namespace cpslam {
namespace {

using test::frame;

constexpr double kInterval_s = 1.0 / 30.0;

TEST(DeviceClock, MicrosecondsBecomeSecondsWithoutLoss) {
  // The last one is today, in microseconds since 1970.
  for (const std::uint64_t us : {std::uint64_t{1}, std::uint64_t{33'367}, std::uint64_t{1'000'000'000'001},
                                 std::uint64_t{1'795'000'000'123'457}}) {
    DeviceClock clock(true, kInterval_s);
    const DeviceClock::Times times = clock.read(frame(us, us + 7));
    EXPECT_EQ(std::llround(times.time_s * 1e6), static_cast<long long>(us));
    EXPECT_EQ(std::llround(times.depth_time_s * 1e6), static_cast<long long>(us + 7));
    EXPECT_FALSE(times.jump_s);
  }
}

TEST(DeviceClock, DepthMayBeTakenBefore) {
  DeviceClock clock(true, kInterval_s);
  const DeviceClock::Times times = clock.read(frame(1'000'000, 990'000));
  EXPECT_DOUBLE_EQ(times.time_s, 1.0);
  EXPECT_DOUBLE_EQ(times.depth_time_s, 0.99);
}

TEST(DeviceClock, LateArrivalsAndLostFramesAreNoJumps) {
  DeviceClock clock(true, kInterval_s);
  EXPECT_FALSE(clock.read(frame(1'000'000, 1'000'000, 10.0)).jump_s);
  EXPECT_FALSE(clock.read(frame(1'033'000, 1'033'000, 10.5)).jump_s) << "waited on the way";
  EXPECT_FALSE(clock.read(frame(1'500'000, 1'500'000, 10.51)).jump_s) << "and those after it caught up";
  EXPECT_FALSE(clock.read(frame(6'500'000, 6'500'000, 15.5)).jump_s) << "five seconds without a frame";
  const DeviceClock::Times times = clock.read(frame(6'600'000, 6'600'000, 15.6));
  EXPECT_FALSE(times.jump_s);
  EXPECT_DOUBLE_EQ(times.time_s, 6.6);
}

TEST(DeviceClock, AJumpBackIsToldAndBridgedByTheHostsClock) {
  DeviceClock clock(true, kInterval_s);
  (void)clock.read(frame(100'000'000, 100'000'000, 10.0));
  const DeviceClock::Times jumped = clock.read(frame(2'000'000, 2'001'000, 10.25));
  ASSERT_TRUE(jumped.jump_s);
  EXPECT_NEAR(*jumped.jump_s, -98.25, 1e-9);
  EXPECT_NEAR(jumped.time_s, 100.25, 1e-9);
  EXPECT_NEAR(jumped.depth_time_s, 100.251, 1e-9);
  const DeviceClock::Times next = clock.read(frame(2'040'000, 2'040'000, 10.35));
  EXPECT_FALSE(next.jump_s);
  EXPECT_NEAR(next.time_s, 100.29, 1e-9) << "the camera's own interval again";
}

TEST(DeviceClock, AJumpAheadIsToldAndBridged) {
  DeviceClock clock(true, kInterval_s);
  (void)clock.read(frame(1'000'000, 1'000'000, 10.0));
  const DeviceClock::Times jumped = clock.read(frame(501'000'000, 501'000'000, 10.1));
  ASSERT_TRUE(jumped.jump_s);
  EXPECT_NEAR(*jumped.jump_s, 499.9, 1e-9);
  EXPECT_NEAR(jumped.time_s, 1.1, 1e-9);
}

TEST(DeviceClock, TheSameStampTwiceIsAJumpBack) {
  DeviceClock clock(true, kInterval_s);
  (void)clock.read(frame(1'000'000, 1'000'000, 10.0));
  const DeviceClock::Times times = clock.read(frame(1'000'000, 1'000'000, 10.0));
  EXPECT_TRUE(times.jump_s);
  EXPECT_GT(times.time_s, 1.0);
}

TEST(DeviceClock, ACameraThatWasOpenedAnewGoesOnWithoutAJump) {
  DeviceClock clock(true, kInterval_s);
  (void)clock.read(frame(50'000'000, 50'000'000, 10.0));
  clock.restart();
  const DeviceClock::Times times = clock.read(frame(1'000, 1'000, 14.0));
  EXPECT_FALSE(times.jump_s);
  EXPECT_NEAR(times.time_s, 54.0, 1e-9);
}

TEST(DeviceClock, AFileKeepsItsGapsAndBridgesWhatRunsBack) {
  DeviceClock clock(false, kInterval_s);
  (void)clock.read(frame(1'000'000, 1'000'000));
  const DeviceClock::Times gap = clock.read(frame(9'000'000, 9'000'000));
  EXPECT_TRUE(gap.jump_s);
  EXPECT_DOUBLE_EQ(gap.time_s, 9.0);
  const DeviceClock::Times back = clock.read(frame(500'000, 500'000));
  ASSERT_TRUE(back.jump_s);
  EXPECT_LT(*back.jump_s, 0.0);
  EXPECT_NEAR(back.time_s, 9.0 + kInterval_s, 1e-6);
  const DeviceClock::Times set = clock.read(frame(90'000'000'000, 90'000'000'000));
  EXPECT_TRUE(set.jump_s);
  EXPECT_NEAR(set.time_s, 9.0 + 2.0 * kInterval_s, 1e-5) << "a day: somebody has set the clock";
}

TEST(DeviceClock, SecondsGrowWhateverTheCameraSays) {
  Random random(3);
  for (const bool live : {false, true}) {
    DeviceClock clock(live, kInterval_s);
    double last_s = -1e300, arrived_s = 0.0;
    std::uint64_t us = 0;
    for (int i = 0; i < 2000; ++i) {
      const double kind = random.uniform();
      if (kind < 0.05) {
        us = random.index(std::uint64_t{1} << 62U);
      } else if (kind < 0.1) {
        us -= std::min<std::uint64_t>(us, random.index(100'000));
      } else {
        us += 33'333;
      }
      if (random.uniform() < 0.02) clock.restart();
      arrived_s += random.uniform(0.0, 0.07);
      const double time_s = clock.read(frame(us, us, arrived_s)).time_s;
      ASSERT_GT(time_s, last_s) << i;
      last_s = time_s;
    }
  }
}

}  // namespace
}  // namespace cpslam
