#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <latch>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "util/worker.h"

namespace cpslam {
namespace {

/// Holds its item until the stop token is set.
struct Patient {
  std::latch entered{1};
  std::atomic<int> handled = 0;

  void operator()(const std::stop_token& stop) {
    entered.count_down();
    std::mutex mutex;
    std::condition_variable_any never;
    std::unique_lock lock(mutex);
    never.wait(lock, stop, [] { return false; });
    ++handled;
  }
};

TEST(WorkerStop, TwiceAndWithoutStart) {
  Worker<int> worker([](int&&, const std::stop_token&) {}, 1);
  ASSERT_TRUE(worker.push(1));
  worker.stop();
  EXPECT_EQ(worker.load(), 0U);
  worker.stop(OnStop::kDrain);
  worker.stop();
  EXPECT_FALSE(worker.push(1));
  EXPECT_NO_THROW(worker.wait_idle());
  EXPECT_NO_THROW(worker.pause().get());
  EXPECT_NO_THROW(worker.reset().get());
}

TEST(WorkerStop, DrainHandlesWhatIsQueuedEvenWhenPaused) {
  std::vector<int> handled;
  Worker<int> worker([&](int&& item, const std::stop_token&) { handled.push_back(item); }, 3);
  worker.start();
  worker.pause().get();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(worker.push(i));
  worker.stop(OnStop::kDrain);
  EXPECT_EQ(handled, (std::vector<int>{0, 1, 2}));
  EXPECT_FALSE(worker.push(3));
}

TEST(WorkerStop, DropReachesTheHandlerThroughItsToken) {
  Patient patient;
  Worker<int> worker([&](int&&, const std::stop_token& stop) { patient(stop); }, 2);
  worker.start();
  ASSERT_TRUE(worker.push(0));
  patient.entered.wait();
  ASSERT_TRUE(worker.push(1));
  ASSERT_TRUE(worker.push(2));
  worker.stop();
  EXPECT_EQ(patient.handled, 1);
  EXPECT_EQ(worker.load(), 0U);
}

TEST(WorkerStop, FromAnotherThreadWakesPushersAndWaiters) {
  Patient patient;
  Worker<int> worker([&](int&&, const std::stop_token& stop) { patient(stop); }, 1);
  worker.start();
  ASSERT_TRUE(worker.push(0));
  patient.entered.wait();
  ASSERT_TRUE(worker.push(1));
  auto pushed = std::async(std::launch::async, [&] { return worker.push(2); });
  auto idle = std::async(std::launch::async, [&] { worker.wait_idle(); });
  auto paused = worker.pause();
  std::jthread([&] { worker.stop(); }).join();
  EXPECT_FALSE(pushed.get());
  EXPECT_NO_THROW(idle.get());
  EXPECT_NO_THROW(paused.get());
}

TEST(WorkerStop, ADropCutsADrainShort) {
  Patient patient;
  Worker<int> worker([&](int&&, const std::stop_token& stop) { patient(stop); }, 2);
  worker.start();
  ASSERT_TRUE(worker.push(0));
  patient.entered.wait();
  ASSERT_TRUE(worker.push(1));
  auto drained = std::async(std::launch::async, [&] { worker.stop(OnStop::kDrain); });
  worker.stop(OnStop::kDrop);
  drained.get();
  EXPECT_EQ(patient.handled, 1);
}

TEST(WorkerStop, ManyThreadsAtOnce) {
  for (int round = 0; round < 50; ++round) {
    Worker<int> worker([](int&&, const std::stop_token&) {}, 2);
    worker.start();
    std::vector<std::jthread> threads;
    threads.emplace_back([&] {
      while (worker.push(0)) {
      }
    });
    for (int i = 0; i < 3; ++i) threads.emplace_back([&] { worker.stop(); });
    threads.emplace_back([&] { worker.pause().get(); });
  }
}

TEST(WorkerStop, DestructorWithAFullQueueFreesTheItems) {
  const auto item = std::make_shared<int>(0);
  Patient patient;
  {
    Worker<std::shared_ptr<int>> worker(
        [&](std::shared_ptr<int>&&, const std::stop_token& stop) { patient(stop); }, 4);
    worker.start();
    ASSERT_TRUE(worker.push(item));
    patient.entered.wait();
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(worker.push(item));
    EXPECT_EQ(item.use_count(), 6);
  }
  EXPECT_EQ(item.use_count(), 1);
  EXPECT_EQ(patient.handled, 1);
}

TEST(WorkerStop, DestructorOfAPausedAndOfAFailedWorker) {
  const auto item = std::make_shared<int>(0);
  {
    Worker<std::shared_ptr<int>> paused([](std::shared_ptr<int>&&, const std::stop_token&) {}, 4);
    paused.start();
    paused.pause().get();
    ASSERT_TRUE(paused.push(item));
  }
  {
    Worker<std::shared_ptr<int>> failed(
        [](std::shared_ptr<int>&&, const std::stop_token&) { throw std::runtime_error("failed"); }, 4);
    ASSERT_TRUE(failed.push(item));
    ASSERT_TRUE(failed.push(item));
    failed.start();
    EXPECT_THROW(failed.wait_idle(), std::runtime_error);
  }
  EXPECT_EQ(item.use_count(), 1);
}

}  // namespace
}  // namespace cpslam
