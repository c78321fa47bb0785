#include "util/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace cpslam {
namespace {

TEST(Random, GivesThePublishedSequenceOfSplitMix64) {
  Random random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317ULL);
  EXPECT_EQ(random.next(), 3203168211198807973ULL);
  EXPECT_EQ(random.next(), 9817491932198370423ULL);
  EXPECT_EQ(random.next(), 4593380528125082431ULL);
  EXPECT_EQ(random.next(), 16408922859458223821ULL);
}

TEST(Random, EqualSeedsGiveEqualNumbersAndOthersDoNot) {
  Random a(7);
  Random b(7);
  Random c(8);
  for (int i = 0; i < 100; ++i) {
    const double value = a.normal();
    EXPECT_EQ(value, b.normal());
    EXPECT_NE(value, c.normal());
  }
}

TEST(Random, UniformFillsItsInterval) {
  constexpr int kDraws = 100000;
  constexpr int kBins = 20;
  Random random(1);
  std::array<int, kBins> histogram{};
  double sum = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.uniform(-3.0, 5.0);
    ASSERT_GE(value, -3.0);
    ASSERT_LT(value, 5.0);
    sum += value;
    ++histogram[static_cast<std::size_t>((value + 3.0) / 8.0 * kBins)];
  }
  EXPECT_NEAR(sum / kDraws, 1.0, 5.0 * 8.0 / std::sqrt(12.0 * kDraws));
  // Chi-square with 19 degrees of freedom exceeds 50 once in 10^4 seeds; the seed is fixed.
  double chi_square = 0.0;
  constexpr double kExpected = static_cast<double>(kDraws) / kBins;
  for (const int count : histogram) chi_square += (count - kExpected) * (count - kExpected) / kExpected;
  EXPECT_LT(chi_square, 50.0);
}

TEST(Random, IndexReachesEveryValueAndNoOther) {
  Random random(2);
  std::vector<int> histogram(7, 0);
  for (int i = 0; i < 70000; ++i) ++histogram.at(random.index(7));
  for (const int count : histogram) EXPECT_NEAR(count, 10000, 500);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(random.index(1), 0U);
}

TEST(Random, NormalHasTheMomentsOfTheNormalDistribution) {
  constexpr int kDraws = 200000;
  Random random(5);
  double first = 0.0;
  double second = 0.0;
  double third = 0.0;
  double fourth = 0.0;
  int within_one_sigma = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    ASSERT_TRUE(std::isfinite(x));
    first += x;
    second += x * x;
    third += x * x * x;
    fourth += x * x * x * x;
    if (std::abs(x) < 1.0) ++within_one_sigma;
  }
  // Five standard errors each.
  const double error = 5.0 / std::sqrt(kDraws);
  EXPECT_NEAR(first / kDraws, 0.0, error);
  EXPECT_NEAR(second / kDraws, 1.0, std::sqrt(2.0) * error);
  EXPECT_NEAR(third / kDraws, 0.0, std::sqrt(15.0) * error);
  EXPECT_NEAR(fourth / kDraws, 3.0, std::sqrt(96.0) * error);
  EXPECT_NEAR(static_cast<double>(within_one_sigma) / kDraws, 0.6827, 0.5 * error);
}

}  // namespace
}  // namespace cpslam
