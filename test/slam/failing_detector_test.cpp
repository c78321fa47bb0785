// A detector that throws, hangs or is late costs boxes, never frames.
#include <gmock/gmock.h>

#include <stdexcept>

#include "cpslam/system.h"
#include "detect/detector_doubles.h"
#include "slam/simulated_frames.h"

namespace cpslam {
namespace {

using test::SimulatedFrames;

constexpr std::size_t kFrames = 20;

Settings impatient(const SimulatedFrames& frames, BoxesPolicy policy) {
  Settings settings = frames.with_mode(false);
  settings.detector.policy = policy;
  settings.detector.timeout_s = 0.1;
  return settings;
}

void expect_all_tracked(System& system, const SimulatedFrames& frames) {
  for (std::size_t i = 0; i < kFrames; ++i)
    EXPECT_EQ(frames.track(system, i).state, TrackingState::kTracked) << i;
}

TEST(FailingDetector, ThrowingIsReportedAndTrackingGoesOn) {
  const SimulatedFrames frames(kFrames);
  for (const bool sequential : {false, true}) {
    LogBook book;
    System system(frames.with_mode(sequential), detector_that([](double) -> std::vector<PersonBox> {
                    throw std::runtime_error("no network");
                  }),
                  book.sink());
    expect_all_tracked(system, frames);
    system.shutdown();
    EXPECT_EQ(system.statistics().people.detections, kFrames);
    EXPECT_EQ(system.statistics().people.detector_failures, kFrames);
    EXPECT_FALSE(system.statistics().people.detector_stuck);
    EXPECT_THAT(book.at(LogLevel::kError), testing::Contains(testing::HasSubstr("no network")));
  }
}

TEST(FailingDetector, HangingIsReportedAndTrackingGoesOn) {
  const SimulatedFrames frames(kFrames);
  for (const BoxesPolicy policy : {BoxesPolicy::kWait, BoxesPolicy::kLatest}) {
    Gate gate;
    LogBook book;
    {
      System system(impatient(frames, policy), detector_that([&](double time_s) {
                      gate.pass();
                      return box_of(time_s);
                    }),
                    book.sink());
      expect_all_tracked(system, frames);
      gate.wait_for(1);
      system.shutdown();
      EXPECT_TRUE(system.statistics().people.detector_stuck);
      EXPECT_EQ(system.statistics().people.detector_failures, 1U);
      EXPECT_EQ(system.trajectory().size(), kFrames);
      EXPECT_THAT(book.at(LogLevel::kError), testing::Contains(testing::HasSubstr("given up")));
      gate.open();
      EXPECT_TRUE(eventually([&] { return !system.statistics().people.detector_stuck; }));
    }
  }
}

}  // namespace
}  // namespace cpslam
