#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/map_builder.h"

namespace cpslam {
namespace {

using test::add_keyframe;
using test::blank_features;
using test::share_points;
using test::shared_points_of_edge;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

class CovisibilityTest : public testing::Test {
 protected:
  KeyFrameId add() { return add_keyframe(map, blank_features(200)); }
  Map map{synthetic::pyramid()};
};

TEST_F(CovisibilityTest, FifteenSharedPointsMakeAnEdgeAndFourteenDoNot) {
  const KeyFrameId root = add();
  const KeyFrameId fifteen = add();
  const KeyFrameId fourteen = add();
  const KeyFrameId id = add();
  share_points(map, root, id, 30);
  share_points(map, fifteen, id, 15);
  share_points(map, fourteen, id, 14);
  map.update_covisibility(id);
  EXPECT_EQ(shared_points_of_edge(map, id, root), 30);
  EXPECT_EQ(shared_points_of_edge(map, root, id), 30);
  EXPECT_EQ(shared_points_of_edge(map, id, fifteen), 15);
  EXPECT_EQ(shared_points_of_edge(map, fifteen, id), 15);
  EXPECT_EQ(shared_points_of_edge(map, id, fourteen), 0);
  EXPECT_EQ(shared_points_of_edge(map, fourteen, id), 0);
  EXPECT_EQ(map.keyframe(id)->parent, root);
  EXPECT_THAT(map.keyframe(root)->children, ElementsAre(id));
}

TEST_F(CovisibilityTest, BestOneMakesAnEdgeHoweverFewItShares) {
  const KeyFrameId root = add();
  const KeyFrameId other = add();
  const KeyFrameId id = add();
  share_points(map, root, id, 3);
  share_points(map, other, id, 5);
  map.update_covisibility(id);
  EXPECT_THAT(map.best_covisible(id, 10), ElementsAre(other));
  EXPECT_EQ(map.keyframe(id)->parent, other);
}

TEST_F(CovisibilityTest, NeighboursComeByPointsThenByAge) {
  const KeyFrameId root = add();
  const KeyFrameId second = add();
  const KeyFrameId third = add();
  const KeyFrameId id = add();
  share_points(map, third, id, 40);
  share_points(map, second, id, 20);
  share_points(map, root, id, 20);
  map.update_covisibility(id);
  EXPECT_THAT(map.best_covisible(id, 10), ElementsAre(third, root, second));
  EXPECT_THAT(map.best_covisible(id, 2), ElementsAre(third, root));
  EXPECT_TRUE(map.best_covisible(KeyFrameId{}, 2).empty());
}

TEST_F(CovisibilityTest, RecountFollowsLossesOnBothSides) {
  const KeyFrameId root = add();
  const KeyFrameId other = add();
  const KeyFrameId id = add();
  share_points(map, root, id, 30);
  const auto points = share_points(map, other, id, 20);
  map.update_covisibility(id);
  ASSERT_EQ(shared_points_of_edge(map, other, id), 20);
  for (std::size_t i = 0; i < 4; ++i) map.erase_point(points[i]);
  map.update_covisibility(id);
  EXPECT_EQ(shared_points_of_edge(map, other, id), 16);
  EXPECT_EQ(shared_points_of_edge(map, id, other), 16);
  for (std::size_t i = 4; i < 8; ++i) map.erase_point(points[i]);
  map.update_covisibility(id);
  EXPECT_EQ(shared_points_of_edge(map, other, id), 0);
  EXPECT_EQ(shared_points_of_edge(map, id, other), 0);
}

TEST_F(CovisibilityTest, WithoutSharedPointsNoEdgeIsLeft) {
  const KeyFrameId root = add();
  const KeyFrameId id = add();
  const auto points = share_points(map, root, id, 20);
  map.update_covisibility(id);
  for (const MapPointId point : points) map.erase_point(point);
  map.update_covisibility(id);
  EXPECT_TRUE(map.keyframe(id)->covisible.empty());
  EXPECT_TRUE(map.keyframe(root)->covisible.empty());
  EXPECT_EQ(map.keyframe(id)->parent, root) << "the tree stays";
}

TEST_F(CovisibilityTest, ParentIsChosenOnce) {
  const KeyFrameId root = add();
  const KeyFrameId other = add();
  const KeyFrameId id = add();
  share_points(map, root, id, 20);
  map.update_covisibility(id);
  share_points(map, other, id, 50);
  map.update_covisibility(id);
  EXPECT_EQ(map.keyframe(id)->parent, root);
}

TEST_F(CovisibilityTest, RootNeverGetsAParent) {
  const KeyFrameId root = add();
  const KeyFrameId id = add();
  share_points(map, root, id, 20);
  map.update_covisibility(root);
  EXPECT_FALSE(map.keyframe(root)->parent.valid());
  EXPECT_FALSE(map.keyframe(id)->parent.valid());
}

TEST_F(CovisibilityTest, LateParentIsNoDescendant) {
  // A keyframe that shared nothing when it was made has a child by the time it is counted again.
  const KeyFrameId root = add();
  const KeyFrameId late = add();
  map.update_covisibility(late);
  const KeyFrameId child = add();
  const KeyFrameId grandchild = add();
  share_points(map, late, child, 40);
  map.update_covisibility(child);
  ASSERT_EQ(map.keyframe(child)->parent, late);
  share_points(map, child, grandchild, 30);
  share_points(map, late, grandchild, 20);
  map.update_covisibility(grandchild);
  map.update_covisibility(late);
  EXPECT_FALSE(map.keyframe(late)->parent.valid());
  EXPECT_EQ(shared_points_of_edge(map, late, child), 40);
  share_points(map, root, late, 15);
  map.update_covisibility(late);
  EXPECT_EQ(map.keyframe(late)->parent, root) << "the best of those that do not descend from it";
}

TEST_F(CovisibilityTest, ErasingTakesTheEdgesAlong) {
  const KeyFrameId root = add();
  const KeyFrameId id = add();
  const KeyFrameId other = add();
  share_points(map, root, id, 20);
  map.update_covisibility(id);
  share_points(map, id, other, 20);
  share_points(map, root, other, 16);
  map.update_covisibility(other);
  ASSERT_TRUE(map.erase_keyframe(id));
  EXPECT_THAT(map.best_covisible(root, 10), ElementsAre(other));
  EXPECT_THAT(map.best_covisible(other, 10), ElementsAre(root));
}

TEST_F(CovisibilityTest, OrphansFindTheBestNewParentWithoutCycles) {
  // dead's children: near shares most with root's side, far only with near, lone with nobody.
  const KeyFrameId root = add();
  const KeyFrameId dead = add();
  share_points(map, root, dead, 20);
  map.update_covisibility(dead);
  const KeyFrameId near = add();
  share_points(map, dead, near, 40);
  share_points(map, root, near, 20);
  map.update_covisibility(near);
  const KeyFrameId far = add();
  share_points(map, dead, far, 40);
  share_points(map, near, far, 30);
  map.update_covisibility(far);
  const KeyFrameId lone = add();
  share_points(map, dead, lone, 20);
  map.update_covisibility(lone);
  ASSERT_THAT(map.keyframe(dead)->children, UnorderedElementsAre(near, far, lone));
  ASSERT_TRUE(map.erase_keyframe(dead));
  EXPECT_EQ(map.keyframe(near)->parent, root);
  EXPECT_EQ(map.keyframe(far)->parent, near);
  EXPECT_EQ(map.keyframe(lone)->parent, root) << "what shares nothing goes to the grandparent";
  EXPECT_THAT(map.keyframe(root)->children, UnorderedElementsAre(near, lone));
  EXPECT_THAT(map.keyframe(near)->children, ElementsAre(far));
}

TEST_F(CovisibilityTest, LoopEdgesJoinBothEndsOnceAndKeepThem) {
  const KeyFrameId root = add();
  const KeyFrameId a = add();
  const KeyFrameId b = add();
  share_points(map, root, a, 20);
  map.update_covisibility(a);
  share_points(map, a, b, 20);
  map.update_covisibility(b);
  map.add_loop_edge(a, b);
  map.add_loop_edge(b, a);
  map.add_loop_edge(a, a);
  map.add_loop_edge(a, KeyFrameId{});
  EXPECT_THAT(map.keyframe(a)->loops, ElementsAre(b));
  EXPECT_THAT(map.keyframe(b)->loops, ElementsAre(a));
  EXPECT_FALSE(map.erase_keyframe(a));
  EXPECT_FALSE(map.erase_keyframe(b));
  EXPECT_EQ(map.n_keyframes(), 3U);
}

}  // namespace
}  // namespace cpslam
