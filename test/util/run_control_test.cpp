#include "util/run_control.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <thread>

namespace cpslam {
namespace {

/// Takes turns until there are no more; counts them.
class Runner {
 public:
  explicit Runner(RunControl& control)
      : thread_([this, &control] {
          while (control.wait_for_turn()) {
            ++turns_;
            turns_.notify_all();
            std::this_thread::yield();
          }
          ended_.set_value();
        }) {}
  void wait_for(int turns) {
    for (int now = turns_; now < turns; now = turns_) turns_.wait(now);
  }
  [[nodiscard]] int turns() const { return turns_; }
  void wait_for_end() { ended_.get_future().get(); }

 private:
  std::atomic<int> turns_ = 0;
  std::promise<void> ended_;
  std::jthread thread_;
};

TEST(RunControl, RunsFreelyUntilQuit) {
  RunControl control;
  EXPECT_FALSE(control.paused());
  Runner run(control);
  run.wait_for(1000);
  control.quit();
  run.wait_for_end();
  EXPECT_TRUE(control.quitting());
  EXPECT_TRUE(control.token().stop_requested());
}

TEST(RunControl, PausedItTakesExactlyTheStepsAskedFor) {
  RunControl control;
  control.pause();
  Runner run(control);
  control.step();
  run.wait_for(1);
  control.step();
  control.step();
  run.wait_for(3);
  EXPECT_TRUE(control.paused());
  EXPECT_EQ(run.turns(), 3);
  control.quit();
  run.wait_for_end();
  EXPECT_EQ(run.turns(), 3);
}

TEST(RunControl, AStepPausesARunUnderWay) {
  RunControl control;
  control.step();
  EXPECT_TRUE(control.paused());
  EXPECT_TRUE(control.wait_for_turn()) << "the step";
  Runner run(control);
  control.resume();
  run.wait_for(100);
  control.quit();
  run.wait_for_end();
}

TEST(RunControl, ResumingForgetsStepsNotYetTaken) {
  RunControl control;
  control.step();
  control.step();
  control.resume();
  control.pause();
  Runner run(control);
  control.quit();
  run.wait_for_end();
  EXPECT_EQ(run.turns(), 0);
}

TEST(RunControl, QuittingEndsAPausedRun) {
  RunControl control;
  control.pause();
  Runner run(control);
  control.quit();
  run.wait_for_end();
  EXPECT_FALSE(control.wait_for_turn());
}

TEST(RunControl, WishesCountOnceAndTheLatestWordCounts) {
  RunControl control;
  EXPECT_FALSE(control.take_wishes().reset);
  EXPECT_FALSE(control.take_wishes().localization.has_value());
  control.wish_reset();
  control.wish_localization(true);
  control.wish_localization(false);
  EXPECT_TRUE(control.wishes().reset) << "to look does not take";
  const MapWishes taken = control.take_wishes();
  EXPECT_TRUE(taken.reset);
  EXPECT_EQ(taken.localization, std::optional(false));
  EXPECT_FALSE(control.wishes().reset);
  EXPECT_FALSE(control.take_wishes().localization.has_value());
}

TEST(RunControl, TellsHowLongThePauseWas) {
  RunControl control;
  control.pause();
  const auto before = std::chrono::steady_clock::now();
  std::chrono::steady_clock::duration waited{};
  {
    std::jthread run([&] { waited = control.wait_for_turn().value(); });
    std::this_thread::yield();
    control.resume();
  }
  EXPECT_GE(waited.count(), 0);
  EXPECT_LE(waited, std::chrono::steady_clock::now() - before);
}

}  // namespace
}  // namespace cpslam
