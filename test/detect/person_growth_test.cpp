#include "detect/person_growth.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "detect/depth_scene.h"
#include "detect/still_surface.h"

namespace cpslam {
namespace {

/// A grid drawn by hand, a wall at 4 m behind all, and a box in it.
class PersonGrowthTest : public testing::Test {
 protected:
  static constexpr int kColumns = 160;
  static constexpr int kRows = 120;

  GrownSurface grow(float mean_m = 2.0F, const KnownBox& known = {}) {
    const SdfModel model{mean_m, 0.1F, 0.25F, 0.5F};
    const StillSurface still = known_still();
    const SceneEvidence scene{depth_m, people, still};
    PersonGrowth growth(scene, taken);
    return growth.grow(model, box, prior(), background, known);
  }
  [[nodiscard]] StillSurface known_still() const {
    return {depth_m, still_age, still_age, cv::Mat1b(kRows, kColumns, std::uint8_t{0})};
  }
  [[nodiscard]] PlacePrior prior() const {
    return {{box.x * 4.0, box.y * 4.0, box.width * 4.0, box.height * 4.0}, {640, 480}};
  }
  void put(const cv::Rect& where, float depth) { depth_m(where).setTo(depth); }
  static int count(const GrownSurface& surface, const cv::Rect& area) {
    return static_cast<int>(std::count_if(surface.cells.begin(), surface.cells.end(), [&area](int cell) {
      return area.contains({cell % kColumns, cell / kColumns});
    }));
  }

  cv::Mat1f depth_m = cv::Mat1f(kRows, kColumns, 4.0F);
  cv::Mat1b people = cv::Mat1b(kRows, kColumns, std::uint8_t{0});
  cv::Mat1b still_age = cv::Mat1b(kRows, kColumns, std::uint8_t{100});  // nothing has moved
  cv::Mat1b taken = cv::Mat1b(kRows, kColumns, std::uint8_t{0});
  std::vector<GridPlane> background;
  cv::Rect box{60, 30, 30, 60};
  cv::Rect torso{64, 32, 22, 30};
};

TEST_F(PersonGrowthTest, TakesTheWholeConnectedSurfaceInOrder) {
  put(torso, 2.0F);
  const GrownSurface surface = grow();
  EXPECT_EQ(int(surface.cells.size()), torso.area());
  EXPECT_EQ(count(surface, torso), torso.area());
  EXPECT_TRUE(std::is_sorted(surface.cells.begin(), surface.cells.end()));
  EXPECT_FLOAT_EQ(surface.leak, 0.0F);
}

TEST_F(PersonGrowthTest, FollowsASurfaceBeyondTheModelsGate) {
  // An arm stretched out to the camera, a centimetre a cell.
  put(torso, 2.0F);
  for (int i = 0; i < 40; ++i) put({70, 40 + i, 5, 1}, 2.0F - 0.01F * float(i));
  EXPECT_GE(count(grow(), {70, 70, 5, 10}), 45);
}

TEST_F(PersonGrowthTest, StopsAtAStepInDepth) {
  put(torso, 2.0F);
  const cv::Rect table(64, 62, 22, 20);
  put(table, 1.3F);
  const GrownSurface surface = grow();
  EXPECT_EQ(count(surface, table), 0);
  EXPECT_EQ(count(surface, torso), torso.area());
}

TEST_F(PersonGrowthTest, CrossesASmallStepBetweenInliers) {
  put(torso, 2.05F);
  const cv::Rect arm(70, 40, 6, 15);
  put(arm, 1.92F);
  EXPECT_EQ(count(grow(), arm), arm.area());
}

TEST_F(PersonGrowthTest, JumpsAGapWithoutReadings) {
  put(torso, 2.0F);
  put({torso.x, 45, torso.width, 2}, 0.0F);
  const GrownSurface surface = grow();
  EXPECT_EQ(int(surface.cells.size()), torso.area() - 2 * torso.width);
}

TEST_F(PersonGrowthTest, TakesBothPiecesOfSomebodyBehindABar) {
  put(torso, 2.0F);
  const cv::Rect legs(66, 70, 18, 18);
  put(legs, 2.05F);
  put({60, 62, 30, 8}, 1.2F);
  const GrownSurface surface = grow();
  EXPECT_EQ(count(surface, torso), torso.area());
  EXPECT_EQ(count(surface, legs), legs.area());
  EXPECT_EQ(int(surface.cells.size()), torso.area() + legs.area());
}

TEST_F(PersonGrowthTest, LeavesOutWhatGoesOnFarOutsideTheBox) {
  put(torso, 2.0F);
  const cv::Rect desk(20, 70, 120, 15);
  put(desk, 2.1F);
  const GrownSurface surface = grow();
  EXPECT_EQ(count(surface, torso), torso.area());
  EXPECT_EQ(count(surface, desk), 0);
}

TEST_F(PersonGrowthTest, MeasuresHowMuchGoesOnOutside) {
  put({20, 30, 120, 60}, 2.0F);
  EXPECT_GT(grow().leak, 0.5F);
}

TEST_F(PersonGrowthTest, StaysAtItsBox) {
  put({20, 10, 120, 100}, 2.0F);
  const cv::Rect around(box.x - 2, box.y - 2, box.width + 4, box.height + 4);
  const GrownSurface surface = grow();
  EXPECT_EQ(count(surface, around), int(surface.cells.size()));
}

TEST_F(PersonGrowthTest, LeavesTheBackgroundsPlanes) {
  // The floor, which the feet touch without a step.
  put(torso, 2.0F);
  const cv::Rect floor(55, 62, 40, 28);
  for (int y = floor.y; y < floor.br().y; ++y) {
    for (int x = floor.x; x < floor.br().x; ++x) depth_m(y, x) = 1.0F / (0.5F + 0.002F * float(y - 61));
  }
  background = {{0.0F, 0.002F, 0.5F - 61.0F * 0.002F}};
  const GrownSurface surface = grow();
  EXPECT_EQ(count(surface, floor), 0);
  EXPECT_GE(count(surface, torso), torso.area() * 8 / 10);
}

TEST_F(PersonGrowthTest, LeavesWhatIsSomebodyElses) {
  put(torso, 2.0F);
  const cv::Rect other(64, 32, 8, 30);
  taken(other).setTo(1);
  const GrownSurface surface = grow();
  EXPECT_EQ(count(surface, other), 0);
  EXPECT_EQ(int(surface.cells.size()), torso.area() - other.area());
}

TEST_F(PersonGrowthTest, WhatHasJustArrivedInTheBoxIsHis) {
  put(torso, 2.0F);
  still_age(torso).setTo(2);
  const cv::Rect rear_leg(70, 66, 6, 20);
  put(rear_leg, 2.5F);
  EXPECT_EQ(count(grow(), rear_leg), 0) << "stood still for long";
  still_age(rear_leg).setTo(0);
  EXPECT_EQ(count(grow(), rear_leg), rear_leg.area());
}

TEST_F(PersonGrowthTest, WhatStandsStillBesideWhoMovesIsNotHis) {
  put(torso, 2.0F);
  still_age(torso).setTo(1);
  const cv::Rect chair(64, 68, 20, 18);
  put(chair, 2.1F);
  const GrownSurface surface = grow();
  EXPECT_EQ(count(surface, torso), torso.area());
  EXPECT_EQ(count(surface, chair), 0);
}

TEST_F(PersonGrowthTest, ALegThatComesOutFromBehindTheOtherIsHisWhenHeMoves) {
  const cv::Rect leg{80, 64, 6, 16};
  put(torso, 2.0F);
  put(leg, 2.5F);
  still_age(leg).setTo(StillSurface::kUnknownAge);
  KnownBox walker;
  EXPECT_EQ(count(grow(), leg), 0) << "he sits: it may be a chair's";
  walker.moves = true;
  EXPECT_EQ(count(grow(2.0F, walker), leg), leg.area());
  put(leg, 3.0F);
  EXPECT_EQ(count(grow(2.0F, walker), leg), 0) << "too far behind";
  put(leg, 2.5F);
  still_age(leg).setTo(100);
  EXPECT_EQ(count(grow(2.0F, walker), leg), 0) << "it has stood there before";
}

TEST_F(PersonGrowthTest, AnArmBeforeHimIsHisAndSomebodyBeforeHimIsNot) {
  put(torso, 2.0F);
  const cv::Rect arm{70, 64, 5, 12};
  put(arm, 1.5F);
  still_age(arm).setTo(0);
  const GrownSurface with_arm = grow();
  EXPECT_EQ(count(with_arm, arm), arm.area());
  EXPECT_EQ(int(with_arm.front.size()), arm.area()) << "but may turn out to be another one's";
  EXPECT_TRUE(std::is_sorted(with_arm.front.begin(), with_arm.front.end()));
  const cv::Rect somebody{62, 64, 26, 20};
  put(somebody, 1.5F);
  still_age(somebody).setTo(0);
  EXPECT_EQ(count(grow(), somebody), 0);
}

TEST_F(PersonGrowthTest, FindsNothingWhereNoDepthFitsTheModel) {
  EXPECT_TRUE(grow(1.0F).cells.empty());
  depth_m.setTo(0.0F);
  EXPECT_TRUE(grow().cells.empty());
}

TEST_F(PersonGrowthTest, ServesSeveralBoxesOneAfterTheOther) {
  put(torso, 2.0F);
  const StillSurface still = known_still();
  const SceneEvidence scene{depth_m, people, still};
  PersonGrowth growth(scene, taken);
  const SdfModel model{2.0F, 0.1F, 0.25F, 0.5F};
  const std::vector<int> first = growth.grow(model, box, prior(), background, {}).cells;
  const std::vector<int> again = growth.grow(model, box, prior(), background, {}).cells;
  EXPECT_EQ(first, again);
  taken(torso).setTo(1);
  EXPECT_TRUE(growth.grow(model, box, prior(), background, {}).cells.empty());
}

}  // namespace
}  // namespace cpslam
