#include "openni/latency_meter.h"

#include <gtest/gtest.h>

namespace cpslam {
namespace {

LatencyMeter::HostTime at(double seconds) {
  return LatencyMeter::HostTime() +
         std::chrono::duration_cast<LatencyMeter::HostTime::duration>(std::chrono::duration<double>(seconds));
}

TEST(LatencyMeter, TheOffsetOfTheClocksIsNoLatency) {
  for (const double offset_s : {-5000.0, 0.0, 1e6}) {
    LatencyMeter meter;
    EXPECT_NEAR(meter.add(1.0, at(1e7 + 1.0 + offset_s), at(1e7 + 1.02 + offset_s)), 20.0, 1e-3);
    EXPECT_NEAR(meter.add(1.1, at(1e7 + 1.1 + offset_s), at(1e7 + 1.13 + offset_s)), 30.0, 0.02);
  }
}

TEST(LatencyMeter, WhatAFrameWaitedOnTheWayCounts) {
  LatencyMeter meter;
  (void)meter.add(1.0, at(11.0), at(11.01));
  EXPECT_NEAR(meter.add(1.1, at(11.15), at(11.17)), 70.0, 0.02);
}

TEST(LatencyMeter, TheQuickestArrivalIsTheMeasure) {
  LatencyMeter meter;
  EXPECT_NEAR(meter.add(1.0, at(11.05), at(11.06)), 10.0, 1e-6) << "nothing else is known yet";
  EXPECT_NEAR(meter.add(1.1, at(11.1), at(11.11)), 10.0, 1e-6);
  EXPECT_NEAR(meter.add(1.2, at(11.25), at(11.26)), 60.0, 0.02);
}

TEST(LatencyMeter, ClocksThatDriftApartAreFollowed) {
  LatencyMeter meter;
  double worst_ms = 0.0;
  for (int i = 0; i < 30 * 3600; ++i) {  // an hour
    const double time_s = i / 30.0;
    const double arrived_s = 10.0 + time_s * (1.0 + 5e-5);
    worst_ms = std::max(worst_ms, meter.add(time_s, at(arrived_s), at(arrived_s + 0.01)));
  }
  EXPECT_NEAR(worst_ms, 10.0, 0.1);
}

}  // namespace
}  // namespace cpslam
