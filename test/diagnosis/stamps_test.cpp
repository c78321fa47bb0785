#include "diagnosis/stamps.h"

#include <gmock/gmock.h>

#include <vector>

#include "diagnosis/findings.h"

namespace cpslam::diagnosis {
namespace {

using testing::HasSubstr;

std::vector<double> even(std::size_t n, double interval_s, double start_s = 100.0) {
  std::vector<double> stamps;
  for (std::size_t i = 0; i < n; ++i) stamps.push_back(start_s + static_cast<double>(i) * interval_s);
  return stamps;
}

TEST(Rhythm, GapsRepeatsAndStepsBack) {
  const Rhythm rhythm = find_rhythm(std::vector<double>{0.0, 0.1, 0.2, 0.2, 0.5, 0.6, 0.4, 0.5, 0.6});
  EXPECT_NEAR(rhythm.interval_s, 0.1, 1e-12);
  EXPECT_NEAR(rhythm.longest_s, 0.3, 1e-12);
  EXPECT_EQ(rhythm.longest_at_s, 0.2);
  EXPECT_EQ(rhythm.n_repeated, 1U);
  EXPECT_EQ(rhythm.n_backward, 1U);
  EXPECT_EQ(rhythm.n_gaps, 1U);
  EXPECT_GT(rhythm.missing_share, 0.0);
}

TEST(Rhythm, OfNothingIsEmpty) {
  EXPECT_EQ(find_rhythm({}).interval_s, 0.0);
  EXPECT_EQ(find_rhythm(std::vector<double>{1.0}).interval_s, 0.0);
  EXPECT_TRUE(check_rhythm("colour", {}, 30.0).empty());
}

TEST(Rhythm, MissingShareIsThatOfDroppedPictures) {
  std::vector<double> stamps;
  for (int i = 0; i < 1000; ++i) {
    if (i % 5 != 3) stamps.push_back(i / 30.0);  // every fifth was dropped
  }
  EXPECT_NEAR(find_rhythm(stamps).missing_share, 0.2, 0.002);
  EXPECT_EQ(worst_level(check_rhythm("colour", stamps, 30.0)), Level::kWarning);
}

TEST(Rhythm, EvenStampsAreFine) {
  const Findings findings = check_rhythm("colour", even(300, 1.0 / 30.0), 30.0);
  EXPECT_EQ(worst_level(findings), Level::kOk) << texts_above(findings, Level::kOk);
  EXPECT_NEAR(value_of(findings, "frame rate", "rate_hz"), 30.0, 0.01);
}

TEST(Rhythm, DisorderIsAnError) {
  std::vector<double> stamps = even(50, 0.03);
  std::swap(stamps[20], stamps[21]);
  stamps.push_back(stamps.back());
  const Finding finding = worst_of(check_rhythm("depth", stamps, std::nullopt), "frame rate");
  EXPECT_EQ(finding.level, Level::kError);
  EXPECT_THAT(finding.what, HasSubstr("depth: 1 stamps repeat the one before, 1 go back"));
}

TEST(Rhythm, LongGapsAreWorseThanShortOnes) {
  const auto with_gap = [](double gap_s) {
    std::vector<double> stamps = even(100, 0.033);
    for (std::size_t i = 50; i < stamps.size(); ++i) stamps[i] += gap_s;
    return worst_level(check_rhythm("colour", stamps, std::nullopt));
  };
  EXPECT_EQ(with_gap(0.033), Level::kNote);
  EXPECT_EQ(with_gap(0.5), Level::kWarning);
  EXPECT_EQ(with_gap(2.0), Level::kError);
}

TEST(Rhythm, SlowCamerasAndWrongNominalRates) {
  EXPECT_EQ(worst_level(check_rhythm("colour", even(50, 0.2), std::nullopt)), Level::kWarning);
  const Finding finding = worst_of(check_rhythm("colour", even(50, 1.0 / 15.0), 30.0), "frame rate");
  EXPECT_EQ(finding.level, Level::kNote);
  EXPECT_THAT(finding.what, HasSubstr("Camera.fps"));
}

TEST(Pairs, StampDifferencesAndPicturesAlone) {
  const std::vector<double> colour = even(100, 0.033);
  const Findings close = check_pairs(colour, even(100, 0.033, 100.008));
  EXPECT_EQ(worst_level(close), Level::kOk);
  EXPECT_NEAR(value_of(close, "colour-depth pairs", "stamp_difference_s"), 0.008, 1e-6);
  EXPECT_EQ(worst_level(check_pairs(colour, even(75, 0.044))), Level::kWarning);
  EXPECT_EQ(worst_level(check_pairs(colour, even(30, 0.11))), Level::kError);
  const Finding other_clock = worst_of(check_pairs(colour, even(100, 0.033, 5000.0)), "colour-depth pairs");
  EXPECT_EQ(other_clock.level, Level::kError);
  EXPECT_THAT(other_clock.advice, HasSubstr("clock"));
}

}  // namespace
}  // namespace cpslam::diagnosis
