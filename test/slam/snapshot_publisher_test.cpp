#include "slam/snapshot_publisher.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace cpslam {
namespace {

/// Counts what it is asked to make.
class PublisherTest : public testing::Test {
 protected:
  void offer(double tracking_ms) {
    publisher.offer(
        tracking_ms,
        [&] {
          FrameSnapshot frame;
          frame.index = static_cast<std::uint64_t>(++frames);
          return frame;
        },
        [&] {
          MapSnapshot map;
          map.corrections = static_cast<std::uint64_t>(++maps);
          return map;
        });
  }

  std::shared_ptr<SnapshotBoard> board = std::make_shared<SnapshotBoard>();
  StageTimer timer;
  SnapshotPublisher publisher{board, timer};
  int frames = 0;
  int maps = 0;
};

TEST_F(PublisherTest, MakesNothingThatNobodyAskedFor) {
  for (int i = 0; i < 100; ++i) offer(10.0);
  EXPECT_EQ(frames, 0);
  EXPECT_EQ(maps, 0);
  EXPECT_EQ(board->frame(), nullptr);
  EXPECT_EQ(board->map(), nullptr);
  EXPECT_TRUE(timer.summary().empty());
}

TEST_F(PublisherTest, AnswersEachRequestOnce) {
  board->request_frame(SnapshotWish::kWhenCheap);
  for (int i = 0; i < 5; ++i) offer(1e6);
  EXPECT_EQ(frames, 1);
  EXPECT_EQ(maps, 0);
  ASSERT_NE(board->frame(), nullptr);
  EXPECT_EQ(board->frame()->index, 1U);
  board->request_map(SnapshotWish::kWhenCheap);
  offer(1e6);
  EXPECT_EQ(frames, 1);
  EXPECT_EQ(maps, 1);
  EXPECT_EQ(board->map()->corrections, 1U);
  EXPECT_EQ(board->map_wish(), SnapshotWish::kNone);
}

TEST_F(PublisherTest, MakesTrackingWorkForThem) {
  // Whatever a snapshot costs here, hardly any tracking does not earn it back, and a long time does.
  board->request_map(SnapshotWish::kWhenCheap);
  offer(0.0);
  EXPECT_EQ(maps, 1) << "the first is free";
  board->request_map(SnapshotWish::kWhenCheap);
  for (int i = 0; i < 10; ++i) offer(0.0);
  EXPECT_EQ(maps, 1);
  offer(1e9);
  EXPECT_EQ(maps, 2);
}

TEST_F(PublisherTest, EveryOneMeansEveryOneUntilAnotherWish) {
  board->request_frame(SnapshotWish::kEvery);
  board->request_map(SnapshotWish::kEvery);
  for (int i = 0; i < 10; ++i) offer(0.0);
  EXPECT_EQ(frames, 10);
  EXPECT_EQ(maps, 10);
  board->request_map(SnapshotWish::kNone);
  board->request_frame(SnapshotWish::kWhenCheap);
  for (int i = 0; i < 10; ++i) offer(0.0);
  EXPECT_EQ(frames, 10) << "ten of them have to be earned first";
  EXPECT_EQ(maps, 10);
}

TEST_F(PublisherTest, ViewersInOtherThreadsSeeWholeSnapshotsInTheirOrder) {
  std::atomic<bool> done = false;
  const auto watch = [&] {
    std::uint64_t last_frame = 0;
    std::uint64_t last_map = 0;
    while (!done) {
      board->request_frame(SnapshotWish::kEvery);
      board->request_map(SnapshotWish::kEvery);
      if (const auto frame = board->frame()) {
        EXPECT_GE(frame->index, last_frame);
        last_frame = frame->index;
      }
      if (const auto map = board->map()) {
        EXPECT_GE(map->corrections, last_map);
        last_map = map->corrections;
      }
    }
  };
  {
    const std::jthread one(watch);
    const std::jthread other(watch);
    while (frames < 2000 || maps < 2000) offer(0.0);
    done = true;
  }
  EXPECT_EQ(board->frame()->index, static_cast<std::uint64_t>(frames));
  EXPECT_EQ(board->map()->corrections, static_cast<std::uint64_t>(maps));
}

TEST_F(PublisherTest, SaysWhatTheyCost) {
  board->request_frame(SnapshotWish::kEvery);
  board->request_map(SnapshotWish::kEvery);
  offer(0.0);
  const std::vector<StageTimes> stages = timer.summary();
  ASSERT_EQ(stages.size(), 2U);
  for (const StageTimes& stage : stages) EXPECT_EQ(stage.count, 1U) << stage.stage;
}

}  // namespace
}  // namespace cpslam
