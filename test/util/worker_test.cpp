#include "util/worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace cpslam {
namespace {

using std::chrono_literals::operator""ms;

template <typename T>
bool still_waits(const std::future<T>& call) {
  return call.wait_for(20ms) == std::future_status::timeout;
}

/// A handler that records its items and holds the first one until released.
struct Gate {
  std::latch entered{1};
  std::latch release{1};
  std::vector<int> handled;  // by the worker's thread only; read it after wait_idle() or stop()

  void operator()(int item) {
    if (handled.empty()) {
      entered.count_down();
      release.wait();
    }
    handled.push_back(item);
  }
};

Worker<int>::Handler through(Gate& gate) {
  return [&gate](int&& item, const std::stop_token&) { gate(item); };
}

TEST(Worker, HandlesItemsInOrder) {
  std::vector<int> handled;
  Worker<int> worker([&](int&& item, const std::stop_token&) { handled.push_back(item); }, 3);
  worker.start();
  std::vector<int> expected;
  for (int i = 0; i < 500; ++i) {
    ASSERT_TRUE(worker.push(i));
    expected.push_back(i);
  }
  worker.wait_idle();
  EXPECT_EQ(worker.load(), 0U);
  EXPECT_EQ(handled, expected);
}

TEST(Worker, HandlesMoveOnlyItems) {
  int sum = 0;
  Worker<std::unique_ptr<int>> worker(
      [&](std::unique_ptr<int>&& item, const std::stop_token&) { sum += *item; }, 2);
  worker.start();
  for (int i = 1; i <= 10; ++i) ASSERT_TRUE(worker.push(std::make_unique<int>(i)));
  worker.wait_idle();
  EXPECT_EQ(sum, 55);
}

TEST(Worker, RefusesNonsense) {
  EXPECT_THROW(Worker<int>(Worker<int>::Handler(), 1), std::invalid_argument);
  EXPECT_THROW(Worker<int>([](int&&, const std::stop_token&) {}, 0), std::invalid_argument);
}

TEST(Worker, StartsOnlyOnce) {
  Worker<int> worker([](int&&, const std::stop_token&) {}, 1);
  worker.start();
  EXPECT_THROW(worker.start(), std::logic_error);
  worker.stop();
  EXPECT_THROW(worker.start(), std::logic_error);
}

TEST(Worker, TakesItemsBeforeItStarts) {
  std::vector<int> handled;
  Worker<int> worker([&](int&& item, const std::stop_token&) { handled.push_back(item); }, 2);
  ASSERT_TRUE(worker.push(1));
  ASSERT_TRUE(worker.push(2));
  EXPECT_EQ(worker.load(), 2U);
  worker.start();
  worker.wait_idle();
  EXPECT_EQ(handled, (std::vector<int>{1, 2}));
}

TEST(Worker, AFullQueueHoldsThePusherBack) {
  Gate gate;
  Worker<int> worker(through(gate), 2);
  worker.start();
  ASSERT_TRUE(worker.push(0));
  gate.entered.wait();
  ASSERT_TRUE(worker.push(1));
  ASSERT_TRUE(worker.push(2));
  EXPECT_EQ(worker.load(), 3U) << "two queued, one in progress";
  int refused = 3;
  EXPECT_FALSE(worker.try_push(refused));
  EXPECT_EQ(refused, 3);
  auto pushed = std::async(std::launch::async, [&] { return worker.push(3); });
  auto below = std::async(std::launch::async, [&] { worker.wait_load_below(2); });
  EXPECT_TRUE(still_waits(pushed));
  EXPECT_TRUE(still_waits(below));
  gate.release.count_down();
  EXPECT_TRUE(pushed.get());
  below.get();
  worker.wait_idle();
  EXPECT_EQ(gate.handled, (std::vector<int>{0, 1, 2, 3}));
}

TEST(Worker, AnExceptionReachesEveryCaller) {
  std::latch entered(1);
  std::latch release(1);
  int calls = 0;
  Worker<int> worker(
      [&](int&&, const std::stop_token&) {
        ++calls;
        entered.count_down();
        release.wait();
        throw std::runtime_error("the handler failed");
      },
      1);
  worker.start();
  ASSERT_TRUE(worker.push(0));
  entered.wait();
  EXPECT_NO_THROW(worker.rethrow_if_failed());
  ASSERT_TRUE(worker.push(1));
  auto blocked_push = std::async(std::launch::async, [&] { return worker.push(2); });
  auto pausing = worker.pause();
  EXPECT_TRUE(still_waits(blocked_push));
  release.count_down();
  EXPECT_THROW(blocked_push.get(), std::runtime_error);
  EXPECT_THROW(pausing.get(), std::runtime_error);
  EXPECT_THROW(worker.wait_idle(), std::runtime_error);
  EXPECT_THROW(worker.push(3), std::runtime_error);
  int item = 4;
  EXPECT_THROW(worker.try_push(item), std::runtime_error);
  EXPECT_THROW(worker.pause().get(), std::runtime_error);
  EXPECT_THROW(worker.reset().get(), std::runtime_error);
  EXPECT_EQ(worker.load(), 0U);
  worker.stop();
  EXPECT_EQ(calls, 1) << "a failed worker handles nothing more";
  try {
    worker.rethrow_if_failed();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), std::string("the handler failed"));
  }
}

TEST(Worker, PauseIsReadyBetweenTwoItemsAndLastsUntilResume) {
  Gate gate;
  Worker<int> worker(through(gate), 4);
  worker.start();
  ASSERT_TRUE(worker.push(0));
  gate.entered.wait();
  ASSERT_TRUE(worker.push(1));
  auto first = worker.pause();
  auto second = worker.pause();
  EXPECT_TRUE(still_waits(first)) << "an item is in progress";
  gate.release.count_down();
  first.get();
  second.get();
  EXPECT_EQ(worker.load(), 1U) << "the paused thread leaves the queue alone";
  ASSERT_TRUE(worker.push(2));
  EXPECT_EQ(worker.load(), 2U);
  worker.pause().get();
  worker.resume();
  worker.wait_idle();
  EXPECT_EQ(gate.handled, (std::vector<int>{0, 1, 2}));
}

TEST(Worker, PauseBeforeStartHoldsFromTheBeginning) {
  std::atomic<int> handled = 0;
  Worker<int> worker([&](int&&, const std::stop_token&) { ++handled; }, 4);
  worker.pause().get();
  worker.start();
  ASSERT_TRUE(worker.push(0));
  worker.pause().get();
  EXPECT_EQ(handled, 0);
  worker.resume();
  worker.wait_idle();
  EXPECT_EQ(handled, 1);
}

TEST(Worker, ResumeBeforeThePauseTookHoldStillFulfilsIt) {
  Gate gate;
  Worker<int> worker(through(gate), 4);
  worker.start();
  ASSERT_TRUE(worker.push(0));
  gate.entered.wait();
  auto paused = worker.pause();
  worker.resume();
  ASSERT_TRUE(worker.push(1));
  gate.release.count_down();
  paused.get();
  worker.wait_idle();
  EXPECT_EQ(gate.handled, (std::vector<int>{0, 1}));
}

TEST(Worker, ResetDropsWhatIsQueuedOnceTheItemInProgressIsDone) {
  Gate gate;
  Worker<int> worker(through(gate), 4);
  worker.start();
  ASSERT_TRUE(worker.push(0));
  gate.entered.wait();
  ASSERT_TRUE(worker.push(1));
  ASSERT_TRUE(worker.push(2));
  auto done = worker.reset();
  EXPECT_TRUE(still_waits(done));
  gate.release.count_down();
  done.get();
  EXPECT_EQ(worker.load(), 0U);
  ASSERT_TRUE(worker.push(3));
  worker.wait_idle();
  EXPECT_EQ(gate.handled, (std::vector<int>{0, 3}));
}

TEST(Worker, ResetWhilePausedAndBeforeStart) {
  std::vector<int> handled;
  Worker<int> worker([&](int&& item, const std::stop_token&) { handled.push_back(item); }, 4);
  ASSERT_TRUE(worker.push(0));
  worker.reset().get();
  EXPECT_EQ(worker.load(), 0U);
  worker.start();
  worker.pause().get();
  ASSERT_TRUE(worker.push(1));
  worker.reset().get();
  EXPECT_EQ(worker.load(), 0U);
  ASSERT_TRUE(worker.push(2));
  worker.resume();
  worker.wait_idle();
  EXPECT_EQ(handled, (std::vector<int>{2}));
}

TEST(Worker, ItemsDieBeforeTheWorkerCountsAsIdle) {
  const auto alive = std::make_shared<int>(0);
  Worker<std::shared_ptr<int>> worker([](std::shared_ptr<int>&&, const std::stop_token&) {}, 8);
  worker.start();
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(worker.push(alive));
    worker.wait_idle();
    ASSERT_EQ(alive.use_count(), 1);
  }
}

TEST(Worker, AQueueThatNeverEmptiesDoesNotStarveAPause) {
  Worker<int> worker([](int&&, const std::stop_token&) {}, 4);
  worker.start();
  std::atomic<bool> enough = false;
  {
    std::vector<std::jthread> pushers;
    for (int p = 0; p < 3; ++p) {
      pushers.emplace_back([&] {
        while (!enough && worker.push(0)) {
        }
      });
    }
    for (int i = 0; i < 50; ++i) {
      worker.pause().get();
      worker.reset().get();
      worker.resume();
    }
    enough = true;
  }
  worker.wait_idle();
  EXPECT_EQ(worker.load(), 0U);
}

TEST(Worker, EveryPusherGetsThrough) {
  constexpr int kPushers = 4;
  constexpr int kItems = 500;
  std::vector<int> handled(kPushers, 0);
  Worker<int> worker(
      [&](int&& pusher, const std::stop_token&) { ++handled[static_cast<std::size_t>(pusher)]; }, 1);
  worker.start();
  {
    std::vector<std::jthread> pushers;
    for (int p = 0; p < kPushers; ++p) {
      pushers.emplace_back([&worker, p] {
        for (int i = 0; i < kItems; ++i) EXPECT_TRUE(worker.push(p));
      });
    }
  }
  worker.wait_idle();
  EXPECT_EQ(handled, std::vector<int>(kPushers, kItems));
}

}  // namespace
}  // namespace cpslam
