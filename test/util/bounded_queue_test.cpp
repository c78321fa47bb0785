#include "util/bounded_queue.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>
#include <numeric>
#include <thread>
#include <vector>

namespace cpslam {
namespace {

using std::chrono_literals::operator""ms;

/// Long enough to catch a call that should wait and does not; a slow machine cannot make it fail.
bool still_waits(const std::future<bool>& call) {
  return call.wait_for(20ms) == std::future_status::timeout;
}

TEST(BoundedQueue, KeepsTheOrder) {
  BoundedQueue<int> queue(3);
  EXPECT_TRUE(queue.push(1));
  EXPECT_TRUE(queue.push(2));
  EXPECT_TRUE(queue.push(3));
  EXPECT_EQ(queue.size(), 3U);
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_TRUE(queue.push(4));
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.pop(), 3);
  EXPECT_EQ(queue.pop(), 4);
  EXPECT_EQ(queue.size(), 0U);
}

TEST(BoundedQueue, RefusesCapacityZero) {
  EXPECT_THROW(BoundedQueue<int>(0), std::invalid_argument);
}

TEST(BoundedQueue, TryPushLeavesTheItemWhenFullOrClosed) {
  BoundedQueue<std::unique_ptr<int>> queue(1);
  auto first = std::make_unique<int>(1);
  auto second = std::make_unique<int>(2);
  EXPECT_TRUE(queue.try_push(first));
  EXPECT_FALSE(first);
  EXPECT_FALSE(queue.try_push(second));
  ASSERT_TRUE(second);
  EXPECT_EQ(*second, 2);
  EXPECT_TRUE(queue.pop().has_value());
  queue.close();
  EXPECT_FALSE(queue.try_push(second));
  EXPECT_TRUE(second);
}

TEST(BoundedQueue, PushWaitsForRoom) {
  BoundedQueue<int> queue(1);
  ASSERT_TRUE(queue.push(1));
  auto pushed = std::async(std::launch::async, [&] { return queue.push(2); });
  EXPECT_TRUE(still_waits(pushed));
  EXPECT_EQ(queue.size(), 1U);
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_TRUE(pushed.get());
  EXPECT_EQ(queue.pop(), 2);
}

TEST(BoundedQueue, DeliversWhatIsQueuedAfterClose) {
  BoundedQueue<int> queue(2);
  ASSERT_TRUE(queue.push(1));
  ASSERT_TRUE(queue.push(2));
  queue.close();
  queue.close();
  EXPECT_TRUE(queue.closed());
  EXPECT_FALSE(queue.push(3));
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.pop(), std::nullopt);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, CloseWakesPusherAndPopper) {
  BoundedQueue<int> full(1);
  BoundedQueue<int> empty(1);
  ASSERT_TRUE(full.push(1));
  auto pushed = std::async(std::launch::async, [&] { return full.push(2); });
  auto popped = std::async(std::launch::async, [&] { return empty.pop().has_value(); });
  EXPECT_TRUE(still_waits(pushed));
  EXPECT_TRUE(still_waits(popped));
  full.close();
  empty.close();
  EXPECT_FALSE(pushed.get());
  EXPECT_FALSE(popped.get());
}

TEST(BoundedQueue, StopRequestEndsEveryWait) {
  BoundedQueue<int> full(1);
  BoundedQueue<int> empty(1);
  ASSERT_TRUE(full.push(1));
  std::stop_source stop;
  auto pushed = std::async(std::launch::async, [&] { return full.push(2, stop.get_token()); });
  auto popped = std::async(std::launch::async, [&] { return empty.pop(stop.get_token()).has_value(); });
  auto below = std::async(std::launch::async, [&] { return full.wait_until_below(1, stop.get_token()); });
  EXPECT_TRUE(still_waits(below));
  stop.request_stop();
  EXPECT_FALSE(pushed.get());
  EXPECT_FALSE(popped.get());
  EXPECT_FALSE(below.get());
  EXPECT_EQ(full.size(), 1U) << "what is queued stays";
}

TEST(BoundedQueue, WaitUntilBelow) {
  BoundedQueue<int> queue(3);
  EXPECT_TRUE(queue.wait_until_below(1));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(queue.push(i));
  EXPECT_TRUE(queue.wait_until_below(4));
  auto below_two = std::async(std::launch::async, [&] { return queue.wait_until_below(2); });
  EXPECT_EQ(queue.pop(), 0);
  EXPECT_TRUE(still_waits(below_two));
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_TRUE(below_two.get());
  queue.close();
  EXPECT_FALSE(queue.wait_until_below(1));
}

TEST(BoundedQueue, ManyProducersAndConsumersLoseAndRepeatNothing) {
  constexpr int kThreads = 4;
  constexpr int kItems = 2000;
  BoundedQueue<int> queue(5);
  std::vector<std::vector<int>> received(kThreads);
  {
    std::vector<std::jthread> consumers;
    for (auto& mine : received) {
      consumers.emplace_back([&queue, &mine] {
        while (const auto item = queue.pop()) mine.push_back(*item);
      });
    }
    {
      std::vector<std::jthread> producers;
      for (int p = 0; p < kThreads; ++p) {
        producers.emplace_back([&queue, p] {
          for (int i = 0; i < kItems; ++i) EXPECT_TRUE(queue.push(p * kItems + i));
        });
      }
    }
    queue.close();
  }
  std::vector<int> times_seen(kThreads * kItems, 0);
  for (const auto& mine : received) {
    std::vector<int> last(kThreads, -1);
    for (const int item : mine) {
      ++times_seen.at(static_cast<std::size_t>(item));
      int& last_of_producer = last[static_cast<std::size_t>(item / kItems)];
      EXPECT_LT(last_of_producer, item) << "a consumer sees each producer's items in order";
      last_of_producer = item;
    }
  }
  EXPECT_EQ(times_seen, std::vector<int>(kThreads * kItems, 1));
}

}  // namespace
}  // namespace cpslam
