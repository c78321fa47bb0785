#include "slam/loop_consistency.h"

#include <gtest/gtest.h>

#include "slam/loop_scene.h"

namespace cpslam {
namespace {

using Ids = std::vector<KeyFrameId>;

class LoopConsistencyTest : public testing::Test {
 protected:
  scene::RoundWalk walk{{.keyframes = 24}};
  LoopConsistency consistency{3};
  const Ids& ids = walk.keyframes;
};

TEST_F(LoopConsistencyTest, NeedsSeveralKeyframesInARow) {
  EXPECT_EQ(consistency.update(walk.map, Ids{ids[4]}), Ids{});
  EXPECT_EQ(consistency.update(walk.map, Ids{ids[5]}), Ids{})
      << "a neighbour of the first counts as the same place";
  EXPECT_EQ(consistency.update(walk.map, Ids{ids[5]}), Ids{ids[5]});
  EXPECT_EQ(consistency.update(walk.map, Ids{ids[6]}), Ids{ids[6]});
}

TEST_F(LoopConsistencyTest, AnotherPlaceBeginsAnew) {
  (void)consistency.update(walk.map, Ids{ids[2]});
  (void)consistency.update(walk.map, Ids{ids[2]});
  EXPECT_EQ(consistency.update(walk.map, Ids{ids[12]}), Ids{});
  EXPECT_EQ(consistency.update(walk.map, Ids{ids[2]}), Ids{}) << "the chain was broken";
}

TEST_F(LoopConsistencyTest, AKeyframeWithoutCandidatesBreaksTheChain) {
  (void)consistency.update(walk.map, Ids{ids[2]});
  (void)consistency.update(walk.map, Ids{ids[2]});
  EXPECT_EQ(consistency.update(walk.map, Ids{}), Ids{});
  EXPECT_EQ(consistency.update(walk.map, Ids{ids[2]}), Ids{});
}

TEST_F(LoopConsistencyTest, PlacesAreFollowedSideBySide) {
  (void)consistency.update(walk.map, Ids{ids[2], ids[20]});
  (void)consistency.update(walk.map, Ids{ids[20], ids[2]});
  EXPECT_EQ(consistency.update(walk.map, Ids{ids[11], ids[2], ids[21]}), (Ids{ids[2], ids[21]}));
  consistency.reset();
  EXPECT_EQ(consistency.update(walk.map, Ids{ids[2]}), Ids{});
}

}  // namespace
}  // namespace cpslam
