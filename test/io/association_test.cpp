#include "io/association.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "util/random.h"

namespace cpslam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

using Stamps = std::vector<double>;

TEST(Association, ClosestPairComesFirstAndTakesItsPartnerAway) {
  // 1.00 could take 1.01, but 1.015 is nearer to it; 1.00 then has only 0.985 left.
  EXPECT_THAT(associate_stamps(Stamps{1.00, 1.015}, Stamps{0.985, 1.01}, 0.02),
              ElementsAre(Pair(0U, 0U), Pair(1U, 1U)));
  // 1.01 goes to the nearer of its neighbours; the other one stays alone.
  EXPECT_THAT(associate_stamps(Stamps{1.00, 1.022}, Stamps{1.01}, 0.02), ElementsAre(Pair(0U, 0U)));
  EXPECT_THAT(associate_stamps(Stamps{1.00, 1.018}, Stamps{1.01}, 0.02), ElementsAre(Pair(1U, 0U)));
}

TEST(Association, TiesGoToTheEarlier) {
  EXPECT_THAT(associate_stamps(Stamps{1.0, 3.0}, Stamps{2.0}, 1.5), ElementsAre(Pair(0U, 0U)));
  EXPECT_THAT(associate_stamps(Stamps{2.0}, Stamps{1.0, 3.0}, 1.5), ElementsAre(Pair(0U, 0U)));
}

TEST(Association, TheLimitItselfIsTooFar) {
  EXPECT_THAT(associate_stamps(Stamps{1.0}, Stamps{1.5}, 0.5), IsEmpty());
  EXPECT_THAT(associate_stamps(Stamps{1.5}, Stamps{1.0}, 0.5), IsEmpty());
  EXPECT_THAT(associate_stamps(Stamps{1.0}, Stamps{1.5}, 0.5000001), ElementsAre(Pair(0U, 0U)));
}

TEST(Association, NeedsNoOrderAndSkipsNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(associate_stamps(Stamps{3.0, nan, 1.0}, Stamps{1.001, 3.001, nan}, 0.02),
              ElementsAre(Pair(2U, 0U), Pair(0U, 1U)));
  EXPECT_THAT(associate_stamps(Stamps{}, Stamps{1.0}, 0.02), IsEmpty());
  EXPECT_THAT(associate_stamps(Stamps{1.0}, Stamps{}, 0.02), IsEmpty());
}

/// The definition, without any thought of speed: again and again the closest free pair.
std::vector<std::pair<std::size_t, std::size_t>> by_definition(const Stamps& a, const Stamps& b,
                                                               double limit) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  std::set<std::size_t> used_a;
  std::set<std::size_t> used_b;
  while (true) {
    double best = limit;
    std::pair<std::size_t, std::size_t> best_pair;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) {
        if (used_a.contains(i) || used_b.contains(j) || !(std::abs(a[i] - b[j]) < best)) continue;
        best = std::abs(a[i] - b[j]);
        best_pair = {i, j};
      }
    }
    if (best == limit) return {pairs.begin(), pairs.end()};
    pairs.insert(best_pair);
    used_a.insert(best_pair.first);
    used_b.insert(best_pair.second);
  }
}

TEST(Association, AgreesWithTheDefinitionOnRandomLists) {
  Random random(11);
  for (int round = 0; round < 50; ++round) {
    Stamps a;
    Stamps b;
    for (double t = random.uniform(); t < 1.5; t += random.uniform(0.0, 0.05)) a.push_back(t);
    for (double t = random.uniform(); t < 1.5; t += random.uniform(0.0, 0.05)) b.push_back(t);
    EXPECT_EQ(associate_stamps(a, b, 0.02), by_definition(a, b, 0.02));
  }
}

}  // namespace
}  // namespace cpslam
