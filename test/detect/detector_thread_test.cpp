#include "detect/detector_thread.h"

#include <gmock/gmock.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "detect/counted_messages.h"
#include "detect/detector_doubles.h"

namespace cpslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kInterval = 1.0 / 32.0;  // exact in binary
constexpr double kNever = 1000.0;         // a timeout that the tests do not live to see

double stamp(std::uint64_t frame) {
  return static_cast<double>(frame) * kInterval;
}

std::vector<std::uint64_t> frames_of(const std::vector<Detections>& detections) {
  std::vector<std::uint64_t> frames;
  for (const Detections& one : detections) {
    EXPECT_EQ(one.time_s, stamp(one.frame));
    // The box names the image it was found in.
    EXPECT_EQ(one.boxes.size(), 1U);
    EXPECT_EQ(one.boxes.at(0).x, one.time_s);
    frames.push_back(one.frame);
  }
  return frames;
}

class DetectorThreadTest : public testing::Test {
 protected:
  void start(FunctionDetector::Function function, const DetectorThreadOptions& options) {
    thread_ =
        std::make_unique<DetectorThread>(detector_that(std::move(function)), options, timer_, book_.log());
  }
  /// With a detector that waits at the gate in every detection.
  void start_gated(const DetectorThreadOptions& options) {
    start(
        [this](double time_s) {
          gate_.pass();
          return box_of(time_s);
        },
        options);
  }
  void offer(std::uint64_t frame) { thread_->offer(frame, stamp(frame), image_); }
  std::vector<std::uint64_t> collect(std::uint64_t frame) {
    return frames_of(thread_->collect(stamp(frame)));
  }
  std::vector<std::uint64_t> offer_and_collect(std::uint64_t frame) {
    offer(frame);
    return collect(frame);
  }
  /// What each of the frames gets.
  std::vector<std::vector<std::uint64_t>> deliveries(std::uint64_t n_frames) {
    std::vector<std::vector<std::uint64_t>> all;
    for (std::uint64_t frame = 0; frame < n_frames; ++frame) all.push_back(offer_and_collect(frame));
    return all;
  }

  const cv::Mat image_ = cv::Mat::zeros(8, 8, CV_8UC3);
  StageTimer timer_;
  LogBook book_;
  Gate gate_;  // before the thread: lives longer
  std::unique_ptr<DetectorThread> thread_;
};

DetectorThreadOptions options(BoxesPolicy policy, bool sequential = false) {
  DetectorThreadOptions options;
  options.policy = policy;
  options.sequential = sequential;
  options.timeout_s = kNever;
  return options;
}

using Wait = DetectorThreadTest;
using Latest = DetectorThreadTest;
using Sequential = DetectorThreadTest;
using Pretended = DetectorThreadTest;
using Ending = DetectorThreadTest;

TEST_F(Wait, EveryFrameGetsItsOwnBoxes) {
  std::atomic<bool> elsewhere = true;
  const std::thread::id here = std::this_thread::get_id();
  start(
      [&](double time_s) {
        if (std::this_thread::get_id() == here) elsewhere = false;
        return box_of(time_s);
      },
      options(BoxesPolicy::kWait));
  for (std::uint64_t frame = 0; frame < 200; ++frame)
    EXPECT_THAT(offer_and_collect(frame), ElementsAre(frame));
  EXPECT_TRUE(elsewhere);
  EXPECT_EQ(thread_->n_detections(), 200U);
  EXPECT_EQ(thread_->n_failures(), 0U);
  ASSERT_EQ(timer_.summary().size(), 1U);
  EXPECT_EQ(timer_.summary()[0].stage, "detect");
  EXPECT_EQ(timer_.summary()[0].count, 200U);
}

TEST_F(Wait, DetectsWhileTheCallerDoesOtherThings) {
  start_gated(options(BoxesPolicy::kWait));
  offer(0);
  gate_.wait_for(1);  // the detection runs while we are here
  gate_.open();
  EXPECT_THAT(collect(0), ElementsAre(0));
}

TEST_F(Wait, AnImageWithoutPeopleIsADetectionToo) {
  start([](double) { return std::vector<PersonBox>{}; }, options(BoxesPolicy::kWait));
  offer(0);
  const std::vector<Detections> detections = thread_->collect(stamp(0));
  ASSERT_EQ(detections.size(), 1U);
  EXPECT_THAT(detections[0].boxes, IsEmpty());
}

TEST_F(Wait, ThrowingCostsTheBoxesOfOneFrame) {
  start(
      [](double time_s) {
        if (time_s == stamp(1)) throw std::runtime_error("network on fire");
        if (time_s == stamp(2)) throw 42;
        return box_of(time_s);
      },
      options(BoxesPolicy::kWait));
  EXPECT_THAT(deliveries(4), ElementsAre(ElementsAre(0), IsEmpty(), IsEmpty(), ElementsAre(3)));
  EXPECT_EQ(thread_->n_detections(), 4U);
  EXPECT_EQ(thread_->n_failures(), 2U);
  EXPECT_FALSE(thread_->is_stuck());
  const std::vector<std::string> errors = book_.at(LogLevel::kError);
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_THAT(errors[0], testing::AllOf(HasSubstr("network on fire"), HasSubstr("the test's own"),
                                        HasSubstr("0.031250")));
  EXPECT_THAT(errors[1], HasSubstr("unknown type"));
}

TEST_F(Wait, ManyFailuresAreCountedButNotAllShown) {
  start([](double) -> std::vector<PersonBox> { throw std::runtime_error("no"); },
        options(BoxesPolicy::kWait));
  for (std::uint64_t frame = 0; frame < 50; ++frame) EXPECT_THAT(offer_and_collect(frame), IsEmpty());
  EXPECT_EQ(thread_->n_failures(), 50U);
  const std::vector<std::string> errors = book_.at(LogLevel::kError);
  ASSERT_EQ(errors.size(), CountedMessages::kShown);
  EXPECT_THAT(errors.back(), HasSubstr("only counted"));
}

TEST_F(Wait, AHangingDetectorIsGivenUpAndComesBack) {
  DetectorThreadOptions impatient = options(BoxesPolicy::kWait);
  impatient.timeout_s = 0.2;
  start(
      [&](double time_s) {
        if (time_s == stamp(1)) gate_.pass();
        return box_of(time_s);
      },
      impatient);
  // The first may be slow to start on a busy machine; it counts nothing here.
  static_cast<void>(offer_and_collect(0));
  ASSERT_TRUE(eventually([&] { return !thread_->is_stuck(); }));
  static_cast<void>(collect(0));
  const std::size_t failures = thread_->n_failures();
  EXPECT_THAT(offer_and_collect(1), IsEmpty());
  EXPECT_TRUE(thread_->is_stuck());
  EXPECT_EQ(thread_->n_failures(), failures + 1);
  EXPECT_EQ(gate_.arrived(), 1);
  // The others do not wait a timeout each, nor behind it: 100 of them would be 20 s.
  const auto start = std::chrono::steady_clock::now();
  for (std::uint64_t frame = 2; frame < 102; ++frame) EXPECT_THAT(offer_and_collect(frame), IsEmpty());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  EXPECT_EQ(thread_->n_detections(), 2U);
  gate_.open();
  ASSERT_TRUE(eventually([&] { return !thread_->is_stuck(); }));
  EXPECT_EQ(thread_->n_detections(), 2U) << "counted when it was given up";
  EXPECT_THAT(offer_and_collect(102), testing::Contains(1U)) << "late, but with its own frame";
  EXPECT_THAT(book_.at(LogLevel::kError).back(), HasSubstr("given up"));
  EXPECT_THAT(book_.at(LogLevel::kWarning).back(), HasSubstr("100 images were not shown"));
}

TEST_F(Wait, LateBoxesComeBeforeTheFramesOwn) {
  DetectorThreadOptions impatient = options(BoxesPolicy::kWait);
  impatient.timeout_s = 1.0;
  start(
      [&](double time_s) {
        if (time_s == stamp(0)) gate_.pass();
        return box_of(time_s);
      },
      impatient);
  EXPECT_THAT(offer_and_collect(0), IsEmpty());
  gate_.open();
  ASSERT_TRUE(eventually([&] { return !thread_->is_stuck(); }));
  EXPECT_THAT(offer_and_collect(1), ElementsAre(0, 1));
}

TEST_F(Latest, ANewerImageReplacesTheOneThatWaits) {
  start_gated(options(BoxesPolicy::kLatest));
  offer(0);
  gate_.wait_for(1);
  EXPECT_THAT(collect(0), IsEmpty());
  for (std::uint64_t frame = 1; frame < 50; ++frame) EXPECT_THAT(offer_and_collect(frame), IsEmpty());
  gate_.open();
  ASSERT_TRUE(eventually([&] { return thread_->n_detections() == 2; }));
  EXPECT_THAT(collect(49), ElementsAre(0, 49));
  EXPECT_THAT(collect(50), IsEmpty());
}

TEST_F(Latest, NoFrameWaitsForAHangingDetectorAndItsReturnIsUsed) {
  DetectorThreadOptions impatient = options(BoxesPolicy::kLatest);
  impatient.timeout_s = 0.01;
  start(
      [&](double time_s) {
        if (time_s == stamp(0)) gate_.pass();
        return box_of(time_s);
      },
      impatient);
  offer(0);
  ASSERT_TRUE(eventually([&] { return collect(0).empty() && thread_->is_stuck(); }));
  EXPECT_EQ(thread_->n_failures(), 1U);
  for (std::uint64_t frame = 1; frame < 20; ++frame) EXPECT_THAT(offer_and_collect(frame), IsEmpty());
  EXPECT_EQ(book_.at(LogLevel::kError).size(), 1U);
  gate_.open();
  ASSERT_TRUE(eventually([&] { return thread_->n_detections() == 2; }));
  EXPECT_THAT(collect(19), ElementsAre(0, 19));
  EXPECT_FALSE(thread_->is_stuck());
}

TEST_F(Latest, ThrowingIsSurvived) {
  start([](double) -> std::vector<PersonBox> { throw std::runtime_error("no"); },
        options(BoxesPolicy::kLatest));
  for (std::uint64_t frame = 0; frame < 10; ++frame) {
    offer(frame);
    ASSERT_TRUE(eventually([&] { return thread_->n_failures() == frame + 1; }));
    EXPECT_THAT(collect(frame), IsEmpty());
  }
}

TEST_F(Sequential, DetectsInTheCallersThread) {
  const std::thread::id here = std::this_thread::get_id();
  for (const BoxesPolicy policy : {BoxesPolicy::kWait, BoxesPolicy::kLatest}) {
    start(
        [&](double time_s) {
          EXPECT_EQ(std::this_thread::get_id(), here);
          if (time_s == stamp(1)) throw std::runtime_error("no");
          return box_of(time_s);
        },
        options(policy, true));
    EXPECT_THAT(deliveries(3), ElementsAre(ElementsAre(0), IsEmpty(), ElementsAre(2)));
    EXPECT_EQ(thread_->n_detections(), 3U);
    EXPECT_EQ(thread_->n_failures(), 1U);
  }
}

TEST_F(Pretended, IsTheSameWithAndWithoutAThread) {
  struct Case {
    double rate_hz, delay_s;
  };
  for (const Case& c :
       {Case{6.4, 0.15}, Case{3.0, 0.3}, Case{2.0, 0.5}, Case{0.0, 0.1}, Case{8.0, 0.0}, Case{8.0, 1.0}}) {
    std::vector<std::vector<std::vector<std::uint64_t>>> runs;
    for (const bool sequential : {true, false, false}) {
      DetectorThreadOptions pretended = options(BoxesPolicy::kLatest, sequential);
      pretended.pretend_rate_hz = c.rate_hz;
      pretended.pretend_delay_s = c.delay_s;
      start(box_of, pretended);
      runs.push_back(deliveries(100));
    }
    EXPECT_EQ(runs[0], runs[1]) << c.rate_hz;
    EXPECT_EQ(runs[0], runs[2]) << c.rate_hz;
  }
}

TEST_F(Pretended, BeginsAtItsRateAndArrivesAfterItsDelay) {
  for (const bool sequential : {true, false}) {
    DetectorThreadOptions pretended = options(BoxesPolicy::kLatest, sequential);
    pretended.pretend_rate_hz = 6.4;  // every fifth of 32 frames a second
    pretended.pretend_delay_s = 0.2;  // 6.4 frames
    start(box_of, pretended);
    const auto delivered = deliveries(23);
    for (std::uint64_t frame = 0; frame < delivered.size(); ++frame) {
      if (frame >= 7 && (frame - 7) % 5 == 0) {
        EXPECT_THAT(delivered[frame], ElementsAre(frame - 7)) << frame;
      } else {
        EXPECT_THAT(delivered[frame], IsEmpty()) << frame;
      }
    }
  }
}

TEST_F(Pretended, WhatIsDueIsWaitedForAndNotMissed) {
  DetectorThreadOptions pretended = options(BoxesPolicy::kLatest);
  pretended.pretend_delay_s = 2.0 * kInterval;
  start_gated(pretended);
  EXPECT_THAT(offer_and_collect(0), IsEmpty());
  EXPECT_THAT(offer_and_collect(1), IsEmpty());
  gate_.wait_for(1);
  gate_.open();
  EXPECT_THAT(offer_and_collect(2), ElementsAre(0));
  EXPECT_THAT(offer_and_collect(3), ElementsAre(1));
}

TEST_F(Pretended, AHangingDetectorIsGivenUpWhenItsBoxesAreDue) {
  DetectorThreadOptions pretended = options(BoxesPolicy::kLatest);
  pretended.pretend_delay_s = 2.0 * kInterval;
  pretended.timeout_s = 0.05;
  start_gated(pretended);
  for (std::uint64_t frame = 0; frame < 30; ++frame) EXPECT_THAT(offer_and_collect(frame), IsEmpty());
  EXPECT_TRUE(thread_->is_stuck());
  EXPECT_EQ(thread_->n_failures(), 1U);
  gate_.open();
  ASSERT_TRUE(eventually([&] { return !thread_->is_stuck(); }));
  EXPECT_THAT(collect(30), ElementsAre(0));
  EXPECT_EQ(gate_.arrived(), 1) << "the images in between were dropped";
}

TEST_F(Ending, DropsTheImageThatWaits) {
  start_gated(options(BoxesPolicy::kLatest));
  offer(0);
  gate_.wait_for(1);
  offer(1);
  std::thread opener([&] { gate_.open(); });
  thread_.reset();
  opener.join();
  EXPECT_LE(gate_.arrived(), 2);  // 2 when the opener was first
}

TEST_F(Ending, FinishWaitsForTheDetectionUnderWay) {
  start_gated(options(BoxesPolicy::kLatest));
  offer(0);
  gate_.wait_for(1);
  offer(1);
  std::thread opener([&] { gate_.open(); });
  thread_->finish();
  opener.join();
  EXPECT_FALSE(thread_->is_stuck());
  EXPECT_GE(thread_->n_detections(), 1U);
  const std::size_t before = thread_->n_detections();
  offer(2);
  thread_->finish();
  EXPECT_EQ(thread_->n_detections(), before) << "takes no more images";
}

TEST_F(Ending, FinishDoesNotWaitForAHangingDetector) {
  for (const BoxesPolicy policy : {BoxesPolicy::kWait, BoxesPolicy::kLatest}) {
    Gate gate;
    DetectorThreadOptions impatient = options(policy);
    impatient.timeout_s = 0.05;
    start(
        [&](double time_s) {
          gate.pass();
          return box_of(time_s);
        },
        impatient);
    offer(0);
    gate.wait_for(1);
    thread_->finish();
    EXPECT_TRUE(thread_->is_stuck());
    EXPECT_EQ(thread_->n_failures(), 1U);
    gate.open();
    thread_.reset();
  }
}

TEST_F(Ending, NothingOfferedNothingWaited) {
  start(box_of, options(BoxesPolicy::kWait));
  EXPECT_THAT(collect(0), IsEmpty());
  thread_->finish();
  EXPECT_FALSE(thread_->is_stuck());
  EXPECT_EQ(thread_->n_detections(), 0U);
}

}  // namespace
}  // namespace cpslam
