#include "util/thread_priority.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <thread>

namespace cpslam {
namespace {

int nice_of_this_thread() {
  return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid()));
}

TEST(ThreadPriority, OnlyTheThreadThatAsksAndItsChildrenGiveWay) {
  const int before = nice_of_this_thread();
  int polite = -1;
  int child = -1;
  std::jthread([&] {
    give_way_to_other_threads();
    polite = nice_of_this_thread();
    std::jthread([&] { child = nice_of_this_thread(); }).join();
  }).join();
  EXPECT_EQ(polite, 19);
  EXPECT_EQ(child, polite);
  EXPECT_EQ(nice_of_this_thread(), before);
}

}  // namespace
}  // namespace cpslam
