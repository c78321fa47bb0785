#include "util/stage_timer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "util/random.h"

namespace cpslam {
namespace {

TEST(DurationHistogram, OneDurationIsExact) {
  DurationHistogram histogram;
  EXPECT_EQ(histogram.percentile_ms(0.5), 0.0);
  histogram.add(12.34);
  EXPECT_EQ(histogram.percentile_ms(0.0), 12.34);
  EXPECT_EQ(histogram.percentile_ms(0.5), 12.34);
  EXPECT_EQ(histogram.percentile_ms(1.0), 12.34);
  EXPECT_EQ(histogram.max_ms(), 12.34);
}

TEST(DurationHistogram, PercentilesByNearestRank) {
  DurationHistogram histogram;
  for (const double ms : {40.0, 10.0, 30.0, 20.0}) histogram.add(ms);
  EXPECT_NEAR(histogram.percentile_ms(0.25), 10.0, 0.05);
  EXPECT_NEAR(histogram.percentile_ms(0.5), 20.0, 0.1);
  EXPECT_NEAR(histogram.percentile_ms(0.51), 30.0, 0.15);
  EXPECT_NEAR(histogram.percentile_ms(0.95), 40.0, 0.2);
  EXPECT_EQ(histogram.max_ms(), 40.0);
  EXPECT_EQ(histogram.total_ms(), 100.0);
}

TEST(DurationHistogram, PercentilesOfManyDurationsAreRightToHalfAPercent) {
  Random random(3);
  DurationHistogram histogram;
  std::vector<double> all;
  for (int i = 0; i < 20001; ++i) {
    all.push_back(std::exp(random.uniform(-8.0, 12.0)));  // 0.3 us to 160 s
    histogram.add(all.back());
  }
  std::sort(all.begin(), all.end());
  for (const double fraction : {0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99}) {
    const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(all.size())));
    const double exact = all[rank - 1];
    EXPECT_NEAR(histogram.percentile_ms(fraction), exact, 0.0051 * exact) << fraction;
  }
  EXPECT_EQ(histogram.max_ms(), all.back());
}

TEST(DurationHistogram, TakesTheExtremes) {
  DurationHistogram histogram;
  histogram.add(-1.0);
  histogram.add(std::numeric_limits<double>::quiet_NaN());
  histogram.add(0.0);
  EXPECT_EQ(histogram.percentile_ms(0.5), 0.0);
  histogram.add(1e12);
  EXPECT_EQ(histogram.max_ms(), 1e12);
  EXPECT_EQ(histogram.count(), 4U);
}

TEST(StageTimer, SummaryInTheOrderOfFirstBeginning) {
  StageTimer timer;
  {
    const StageTimer::Scope whole = timer.time("track");
    for (int i = 0; i < 3; ++i) const StageTimer::Scope part = timer.time("extract");
    const StageTimer::Scope unfinished = timer.time("match");
    ASSERT_EQ(timer.summary().size(), 1U) << "only finished stages count";
  }
  timer.add("decode", 5.0);
  timer.add("extract", 1e6);
  const std::vector<StageTimes> summary = timer.summary();
  ASSERT_EQ(summary.size(), 4U);
  EXPECT_EQ(summary[0].stage, "track");
  EXPECT_EQ(summary[1].stage, "extract");
  EXPECT_EQ(summary[2].stage, "match");
  EXPECT_EQ(summary[3].stage, "decode");
  EXPECT_EQ(summary[0].count, 1U);
  EXPECT_EQ(summary[1].count, 4U);
  EXPECT_EQ(summary[1].max_ms, 1e6);
  EXPECT_EQ(summary[3].p50_ms, 5.0);
  EXPECT_EQ(summary[3].p95_ms, 5.0);
  EXPECT_GE(summary[0].max_ms, summary[1].p50_ms) << "the whole lasts longer than its part";
}

TEST(StageTimer, MeasuresElapsedTime) {
  StageTimer timer;
  const auto begin = std::chrono::steady_clock::now();
  {
    const StageTimer::Scope scope = timer.time("spin");
    while (std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(5)) {
    }
  }
  const std::chrono::duration<double, std::milli> outside = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(timer.summary().at(0).max_ms, 0.0);
  EXPECT_LE(timer.summary().at(0).max_ms, outside.count());
}

TEST(StageTimer, CountsFromSeveralThreads) {
  StageTimer timer;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&timer, t] {
        for (int i = 0; i < 500; ++i) {
          const StageTimer::Scope scope = timer.time("shared");
          timer.add(t % 2 == 0 ? "even" : "odd", 1.0);
          EXPECT_LE(timer.summary().size(), 3U);
        }
      });
    }
  }
  std::size_t total = 0;
  for (const StageTimes& stage : timer.summary()) total += stage.count;
  EXPECT_EQ(total, 4000U);
}

}  // namespace
}  // namespace cpslam
