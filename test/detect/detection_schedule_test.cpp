#include "detect/detection_schedule.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

namespace cpslam {
namespace {

/// Frames at which detections begin.
std::vector<int> begins(double rate_hz, const std::vector<double>& stamps_s) {
  DetectionSchedule schedule(rate_hz, 0.0);
  std::vector<int> frames;
  for (std::size_t i = 0; i < stamps_s.size(); ++i) {
    if (schedule.begins_at(stamps_s[i])) frames.push_back(static_cast<int>(i));
  }
  return frames;
}

/// Stamps of a 30 Hz camera as they are written to files, each off by up to jitter_s.
std::vector<double> stamps(int n, double jitter_s) {
  std::vector<double> times_s;
  for (int i = 0; i < n; ++i) {
    const double jitter = jitter_s * std::sin(2.4 * i);
    times_s.push_back(std::round((1305031102.1 + i / 30.0 + jitter) * 1e6) * 1e-6);
  }
  return times_s;
}

std::vector<int> every(int step, int n) {
  std::vector<int> frames;
  for (int i = 0; i < n; i += step) frames.push_back(i);
  return frames;
}

/// Frames after their image at which boxes arrive.
int frames_late(double delay_s) {
  const DetectionSchedule schedule(0.0, delay_s);
  const std::vector<double> times_s = stamps(60, 0.0);
  int frame = 0;
  while (!schedule.is_due(times_s[0], times_s[static_cast<std::size_t>(frame)])) ++frame;
  return frame;
}

TEST(DetectionSchedule, WithoutARateEveryFrameBegins) {
  EXPECT_EQ(begins(0.0, stamps(10, 0.0)), every(1, 10));
}

TEST(DetectionSchedule, ARateAboveTheCamerasIsTheCameras) {
  EXPECT_EQ(begins(30.0, stamps(300, 0.002)), every(1, 300));
  EXPECT_EQ(begins(1000.0, stamps(300, 0.002)), every(1, 300));
}

TEST(DetectionSchedule, SixASecondIsEveryFifthFrame) {
  EXPECT_EQ(begins(6.0, stamps(3000, 0.0)), every(5, 3000));
}

TEST(DetectionSchedule, JitterDoesNotCostFrames) {
  EXPECT_EQ(begins(6.0, stamps(3000, 0.002)), every(5, 3000));
  EXPECT_EQ(begins(2.0, stamps(3000, 0.002)), every(15, 3000));
}

TEST(DetectionSchedule, RatesThatDoNotDivideTheCamerasAreMetOnAverage) {
  for (const double rate_hz : {4.0, 7.0, 11.0, 13.0, 22.0}) {
    const std::vector<int> frames = begins(rate_hz, stamps(3000, 0.002));
    EXPECT_NEAR(static_cast<double>(frames.size()), rate_hz * 100.0, 1.0) << rate_hz;
    for (std::size_t i = 1; i < frames.size(); ++i) {
      EXPECT_GE(frames[i] - frames[i - 1], std::floor(30.0 / rate_hz));
      EXPECT_LE(frames[i] - frames[i - 1], std::ceil(30.0 / rate_hz));
    }
  }
}

TEST(DetectionSchedule, AGapIsNotMadeUpFor) {
  EXPECT_EQ(begins(2.0, {0.0, 0.1, 3.05, 3.1, 3.2, 3.3, 3.4, 3.5, 3.56, 3.6}), (std::vector<int>{0, 2, 8}));
}

TEST(DetectionSchedule, BoxesArriveWithTheFirstFrameAfterTheDelay) {
  EXPECT_EQ(frames_late(0.0), 0);
  EXPECT_EQ(frames_late(0.02), 1);
  EXPECT_EQ(frames_late(0.15), 5);
  EXPECT_EQ(frames_late(0.3), 9);  // 0.299999 s in stamps of six decimals
  EXPECT_EQ(frames_late(0.5), 15);
}

}  // namespace
}  // namespace cpslam
