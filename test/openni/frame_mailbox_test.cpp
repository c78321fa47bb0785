#include "openni/frame_mailbox.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "openni/camera_frames.h"
#include "util/worker.h"

namespace cpslam {
namespace {

using test::frame;
constexpr std::chrono::seconds kLong{60};

TEST(FrameMailbox, TheNewestFrameWins) {
  FrameMailbox mailbox;
  for (const std::uint64_t us : {1U, 2U, 3U}) mailbox.put(frame(us, us));
  CameraFrame taken;
  EXPECT_EQ(mailbox.take(taken, kLong, {}), CameraEvent::kFrame);
  EXPECT_EQ(taken.colour.time_us, 3U);
  EXPECT_EQ(mailbox.dropped(), 2U);
}

TEST(FrameMailbox, NothingInTimeIsAStall) {
  FrameMailbox mailbox;
  CameraFrame taken;
  EXPECT_EQ(mailbox.take(taken, std::chrono::milliseconds(1), {}), CameraEvent::kStalled);
}

TEST(FrameMailbox, TheLastFrameComesBeforeTheEnd) {
  for (const CameraEvent end : {CameraEvent::kEnd, CameraEvent::kUnplugged}) {
    FrameMailbox mailbox;
    mailbox.put(frame(1, 1));
    mailbox.close(end);
    CameraFrame taken;
    EXPECT_EQ(mailbox.take(taken, kLong, {}), CameraEvent::kFrame);
    EXPECT_EQ(mailbox.take(taken, kLong, {}), end);
  }
}

TEST(FrameMailbox, AStopWakesWhoWaits) {
  FrameMailbox mailbox;
  std::stop_source stop;
  Worker<int> stopper([&stop](int&&, const std::stop_token&) { stop.request_stop(); }, 1);
  stopper.push(0);
  stopper.start();
  CameraFrame taken;
  EXPECT_EQ(mailbox.take(taken, kLong, stop.get_token()), CameraEvent::kStopped);
}

TEST(FrameMailbox, FramesPassBetweenThreadsInOrder) {
  FrameMailbox mailbox;
  Worker<int> camera(
      [&mailbox](int&&, const std::stop_token&) {
        for (std::uint64_t us = 1; us <= 10'000; ++us) mailbox.put(frame(us, us));
        mailbox.close(CameraEvent::kEnd);
      },
      1);
  camera.push(0);
  camera.start();
  CameraFrame taken;
  std::uint64_t last = 0, count = 0;
  while (mailbox.take(taken, kLong, {}) == CameraEvent::kFrame) {
    ASSERT_GT(taken.colour.time_us, last);
    last = taken.colour.time_us;
    ++count;
  }
  EXPECT_EQ(last, 10'000U);
  EXPECT_EQ(count + mailbox.dropped(), 10'000U);
}

TEST(FrameMailbox, AFailureIsThrownToWhoTakes) {
  FrameMailbox mailbox;
  mailbox.put(frame(1, 1));
  mailbox.fail(std::make_exception_ptr(std::runtime_error("broken")));
  CameraFrame taken;
  EXPECT_THROW((void)mailbox.take(taken, kLong, {}), std::runtime_error);
}

}  // namespace
}  // namespace cpslam
