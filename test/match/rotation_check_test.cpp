#include "match/rotation_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "util/random.h"

namespace cpslam {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(AgreesWithMajority, KeepsTheThreeFullestBins) {
  std::vector<float> differences;
  const auto add = [&](float degrees, int n) {
    differences.insert(differences.end(), static_cast<std::size_t>(n), degrees);
  };
  add(6.0F, 10);
  add(30.0F, 8);
  add(100.0F, 6);
  add(200.0F, 5);  // the fourth
  const std::vector<bool> agrees = agrees_with_majority(differences);
  for (std::size_t i = 0; i < agrees.size(); ++i) EXPECT_EQ(agrees[i], differences[i] != 200.0F) << i;
}

TEST(AgreesWithMajority, AngleCountsModuloFullTurns) {
  // 3, 363, -357 and 723 degrees are the same; the lone 180 is less than a tenth of 20.
  std::vector<float> differences;
  for (int i = 0; i < 5; ++i) differences.insert(differences.end(), {3.0F, 363.0F, -357.0F, 723.0F});
  differences.push_back(180.0F);
  const std::vector<bool> agrees = agrees_with_majority(differences);
  EXPECT_FALSE(agrees.back());
  EXPECT_THAT(std::vector<bool>(agrees.begin(), agrees.end() - 1), Each(true));
}

TEST(AgreesWithMajority, ATenthOfTheFullestBinIsEnough) {
  std::vector<float> differences(20, 6.0F);
  differences.insert(differences.end(), 2, 90.0F);
  EXPECT_TRUE(agrees_with_majority(differences).back());
  differences.insert(differences.end(), 1, 6.0F);  // now 2 of 21
  EXPECT_FALSE(agrees_with_majority(differences)[20]);
}

TEST(AgreesWithMajority, EdgesOfTheRange) {
  EXPECT_THAT(agrees_with_majority({}), IsEmpty());
  EXPECT_THAT(agrees_with_majority(std::vector<float>{359.99997F}), ElementsAre(true));
  EXPECT_THAT(agrees_with_majority(std::vector<float>{-1e-7F}), ElementsAre(true));
}

TEST(AgreesWithMajority, FindsTheCamerasTurnAmongRandomOnes) {
  Random random(3);
  std::vector<float> differences;
  for (int i = 0; i < 300; ++i) {
    const bool right = i % 3 != 0;
    const double degrees = right ? 67.0 + random.uniform(-4.0, 4.0) : random.uniform(-360.0, 360.0);
    differences.push_back(static_cast<float>(degrees));
  }
  const std::vector<bool> agrees = agrees_with_majority(differences);
  int wrong_kept = 0;
  for (std::size_t i = 0; i < 300; ++i) {
    if (i % 3 != 0) {
      EXPECT_TRUE(agrees[i]);
    } else {
      wrong_kept += agrees[i] ? 1 : 0;
    }
  }
  EXPECT_LT(wrong_kept, 30) << "three bins of thirty hold a tenth of random angles";
}

}  // namespace
}  // namespace cpslam
