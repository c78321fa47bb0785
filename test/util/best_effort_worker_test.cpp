#include "util/best_effort_worker.h"

#include <gtest/gtest.h>

#include <latch>
#include <stdexcept>
#include <string>
#include <vector>

namespace cpslam {
namespace {

TEST(BestEffortWorker, FinishHandlesWhatIsWaiting) {
  std::vector<int> handled;
  BestEffortWorker<int> worker([&](int item) { handled.push_back(item); }, 2, WhenBusy::kWait, {}, "");
  worker.start();
  for (int i = 0; i < 20; ++i) worker.add(i);
  worker.finish();
  ASSERT_EQ(handled.size(), 20U);
  EXPECT_EQ(handled.back(), 19);
  EXPECT_EQ(worker.left_out(), 0U);
  EXPECT_FALSE(worker.failed());
}

TEST(BestEffortWorker, LeavesOutWhatDoesNotFit) {
  std::latch go(1);
  std::vector<int> handled;
  const auto handler = [&](int item) {
    go.wait();
    handled.push_back(item);
  };
  BestEffortWorker<int> worker(handler, 3, WhenBusy::kLeaveOut, {}, "");
  for (int i = 0; i < 10; ++i) worker.add(i);
  worker.start();
  go.count_down();
  worker.finish();
  EXPECT_EQ(handled, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(worker.left_out(), 7U);
  EXPECT_FALSE(worker.failed());
}

TEST(BestEffortWorker, WarnsOnceOfWhatIsThrownAndTakesNoMore) {
  std::vector<std::string> warnings;
  const LogSink log = [&](LogLevel level, const std::string& message) {
    EXPECT_EQ(level, LogLevel::kWarning);
    warnings.push_back(message);
  };
  int handled = 0;
  const auto handler = [&](int) {
    ++handled;
    throw std::runtime_error("disk full");
  };
  BestEffortWorker<int> worker(handler, 1, WhenBusy::kWait, log, "nothing more is written");
  worker.start();
  for (int i = 0; i < 5; ++i) worker.add(i);
  worker.finish();
  worker.add(6);
  worker.finish();
  EXPECT_EQ(handled, 1);
  EXPECT_TRUE(worker.failed());
  EXPECT_EQ(warnings, (std::vector<std::string>{"disk full; nothing more is written"}));
}

}  // namespace
}  // namespace cpslam
