#include "util/fair_shared_mutex.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <shared_mutex>
#include <thread>
#include <vector>

namespace cpslam {
namespace {

TEST(FairSharedMutex, ReadersShare) {
  FairSharedMutex mutex;
  std::latch all_in(3);
  std::vector<std::jthread> readers;
  for (int i = 0; i < 3; ++i) {
    readers.emplace_back([&] {
      const std::shared_lock lock(mutex);
      all_in.arrive_and_wait();  // would never end if they came one by one
    });
  }
}

TEST(FairSharedMutex, WritersExcludeAll) {
  FairSharedMutex mutex;
  int a = 0;
  int b = 0;
  std::atomic<int> torn = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 2; ++i) {
      threads.emplace_back([&] {
        for (int n = 0; n < 5000; ++n) {
          const std::unique_lock lock(mutex);
          ++a;
          ++b;
        }
      });
      threads.emplace_back([&] {
        for (int n = 0; n < 5000; ++n) {
          const std::shared_lock lock(mutex);
          if (a != b) ++torn;
        }
      });
    }
  }
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(a, 10000);
}

TEST(FairSharedMutex, ReadersGetInBetweenWriters) {
  FairSharedMutex mutex;
  std::atomic<bool> done = false;
  std::atomic<long> writes = 0;
  constexpr long kStarved = 1000000;
  std::vector<std::jthread> writers;
  for (int i = 0; i < 2; ++i) {
    writers.emplace_back([&] {
      while (!done && writes < kStarved) {
        const std::unique_lock lock(mutex);
        ++writes;
      }
    });
  }
  for (int n = 0; n < 100; ++n) {
    const std::shared_lock lock(mutex);
    ASSERT_LT(writes, kStarved);
  }
  done = true;
}

}  // namespace
}  // namespace cpslam
