#include "detect/keypoint_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "detect/depth_scene.h"

namespace cpslam {
namespace {

using scene::DepthScene;
using scene::View;

std::vector<int> marked(const std::vector<std::uint8_t>& marks) {
  std::vector<int> indices;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] != 0) indices.push_back(int(i));
  }
  return indices;
}

/// Somebody at 2 m whose surface is the cells (20, 20) to (39, 59), a wall at 4 m behind; cells of 4 px.
class KeypointFilterTest : public testing::Test {
 protected:
  KeypointFilterTest() {
    depth_m(place).setTo(2.0F);
    PersonTrack track;
    track.number = 1;
    for (int y = place.y; y < place.br().y; ++y) {
      for (int x = place.x; x < place.br().x; ++x) track.visible.add(y * 160 + x, depth_m(y, x));
    }
    track.shape = track.visible;
    track.box = {76.0, 76.0, 90.0, 170.0, 0.9};
    tracks.push_back(track);
  }
  [[nodiscard]] bool on_person(float x, float y, float depth) const {
    const DepthKeypoint keypoint{x, y, depth};
    return find_keypoints_on_people(camera, depth_m, tracks, 0.0, {&keypoint, 1}).at(0) != 0;
  }

  GridCamera camera = scene::grid_camera();
  cv::Mat1f depth_m = cv::Mat1f(120, 160, 4.0F);
  cv::Rect place{20, 20, 20, 40};  // 80 to 159.. px across, 80 to 239 down
  std::vector<PersonTrack> tracks;
};

TEST_F(KeypointFilterTest, RemovesWhatIsOnHisSurface) {
  EXPECT_TRUE(on_person(120.0F, 160.0F, 2.0F));
  EXPECT_TRUE(on_person(120.0F, 160.0F, 2.05F));
}

TEST_F(KeypointFilterTest, KeepsWhatIsSeenBesideHim) {
  EXPECT_FALSE(on_person(40.0F, 160.0F, 4.0F));
  EXPECT_FALSE(on_person(400.0F, 300.0F, 2.0F)) << "at his depth, but elsewhere";
}

TEST_F(KeypointFilterTest, KeepsTheBackgroundWithinHisOutline) {
  // A corner of the wall between his arm and his body: the grid's cell took his arm.
  EXPECT_FALSE(on_person(120.0F, 160.0F, 4.0F));
  EXPECT_FALSE(on_person(158.0F, 160.0F, 4.0F));
}

TEST_F(KeypointFilterTest, RemovesTheOutlineOfWhoWalksAtAnyDepth) {
  tracks[0].velocity_m_per_s = {1.0F, 0.0F, 0.0F};
  tracks[0].velocity_variance.setConstant(1e-4F);
  EXPECT_TRUE(on_person(160.0F, 160.0F, 4.0F));
  EXPECT_FALSE(on_person(175.0F, 160.0F, 4.0F));
}

TEST_F(KeypointFilterTest, WhoWalksHasGoneOnSinceTheDepthImage) {
  tracks[0].velocity_m_per_s = {1.0F, 0.0F, 0.0F};
  tracks[0].velocity_variance.setConstant(1e-4F);
  const DepthKeypoint ahead{172.0F, 160.0F, 2.0F};
  EXPECT_EQ(find_keypoints_on_people(camera, depth_m, tracks, 0.0, {&ahead, 1}).at(0), 0);
  EXPECT_EQ(find_keypoints_on_people(camera, depth_m, tracks, 0.1, {&ahead, 1}).at(0), 1);
}

/// Whether keypoints on the person and beside him come back when his surface has the given age.
class RestingTest : public KeypointFilterTest {
 protected:
  [[nodiscard]] bool comes_back(float x, float depth, std::uint8_t age) const {
    const DepthKeypoint keypoint{x, 160.0F, depth};
    const cv::Mat1b ages(depth_m.size(), age);
    return find_keypoints_on_resting_people(camera, ages, tracks, {&keypoint, 1}).at(0) != 0;
  }
};

TEST_F(RestingTest, WhoHasNotMovedForLongGivesHisKeypointsBack) {
  tracks[0].velocity_variance.setConstant(1e-4F);
  EXPECT_TRUE(comes_back(120.0F, 2.0F, 200));
  EXPECT_FALSE(comes_back(120.0F, 2.0F, 10)) << "he has just come";
  EXPECT_FALSE(comes_back(120.0F, 0.0F, 200)) << "without depth nobody knows";
  EXPECT_FALSE(comes_back(400.0F, 2.0F, 200)) << "that is not on him";
}

TEST_F(RestingTest, WhoMovesOrMayMoveGivesNothingBack) {
  EXPECT_FALSE(comes_back(120.0F, 2.0F, 200)) << "his velocity is not known";
  tracks[0].velocity_variance.setConstant(1e-4F);
  tracks[0].velocity_m_per_s = {0.5F, 0.0F, 0.0F};
  EXPECT_FALSE(comes_back(120.0F, 2.0F, 200));
}

TEST_F(KeypointFilterTest, RemovesHisRim) {
  // Right of his last cell, at his depth, up to the width of a cell.
  EXPECT_TRUE(on_person(161.0F, 160.0F, 2.0F));
  EXPECT_TRUE(on_person(120.0F, 78.0F, 2.0F));
  EXPECT_FALSE(on_person(161.0F, 160.0F, 4.0F));
  EXPECT_FALSE(on_person(175.0F, 160.0F, 2.0F));
}

TEST_F(KeypointFilterTest, RemovesWhatHasNoDepthAtHisSurface) {
  EXPECT_TRUE(on_person(120.0F, 160.0F, 0.0F));
  EXPECT_TRUE(on_person(164.0F, 160.0F, 0.0F));
}

TEST_F(KeypointFilterTest, KeepsWhatHasNoDepthWhereTheRoomIsAround) {
  EXPECT_FALSE(on_person(300.0F, 160.0F, 0.0F));
  EXPECT_FALSE(on_person(100.0F, 264.0F, 0.0F)) << "under him";
}

TEST_F(KeypointFilterTest, KeepsTheBackgroundInTheShadowHeThrows) {
  depth_m(cv::Rect(14, 20, 6, 40)).setTo(0.0F);  // left of him
  EXPECT_TRUE(on_person(76.0F, 160.0F, 0.0F)) << "where he was carried to is a guess";
  tracks[0].shown = true;
  EXPECT_FALSE(on_person(76.0F, 160.0F, 0.0F));
  EXPECT_TRUE(on_person(120.0F, 160.0F, 0.0F)) << "a hole in his surface";
  depth_m(cv::Rect(20, 17, 20, 3)).setTo(0.0F);
  EXPECT_TRUE(on_person(120.0F, 75.0F, 0.0F)) << "his hair";
}

TEST_F(KeypointFilterTest, RemovesWhatHasNoDepthInTheHoleOfHisBox) {
  // His black coat: nothing in his box below the surface has a depth.
  tracks[0].box = {76.0, 76.0, 90.0, 380.0, 0.9};
  depth_m(cv::Rect(16, 60, 30, 60)).setTo(0.0F);
  EXPECT_TRUE(on_person(120.0F, 350.0F, 0.0F));
  EXPECT_FALSE(on_person(300.0F, 350.0F, 0.0F));
  tracks[0].box.height = 170.0;
  EXPECT_FALSE(on_person(120.0F, 350.0F, 0.0F));
}

TEST_F(KeypointFilterTest, ADepthImageThatIsOlderThanTheColourImageMissesWhereHeHasGone) {
  tracks[0].velocity_m_per_s = {1.2F, 0.0F, 0.0F};
  tracks[0].velocity_variance.setConstant(0.01F);
  // In 50 ms he walks 6 cm, which are 16 px at 2 m.
  const DepthKeypoint gone_on{170.0F, 160.0F, 2.0F};
  EXPECT_EQ(find_keypoints_on_people(camera, depth_m, tracks, 0.0, {&gone_on, 1}).at(0), 0);
  EXPECT_EQ(find_keypoints_on_people(camera, depth_m, tracks, 0.05, {&gone_on, 1}).at(0), 1);
  const DepthKeypoint far_off{200.0F, 160.0F, 4.0F};
  EXPECT_EQ(find_keypoints_on_people(camera, depth_m, tracks, 0.05, {&far_off, 1}).at(0), 0);
}

TEST_F(KeypointFilterTest, AtTheImagesBorders) {
  for (const auto& [x, y] : {std::pair{0.0F, 0.0F}, {639.0F, 0.0F}, {0.0F, 479.0F}, {639.4F, 479.4F}}) {
    EXPECT_FALSE(on_person(x, y, 4.0F));
    EXPECT_FALSE(on_person(x, y, 0.0F));
  }
}

TEST_F(KeypointFilterTest, NobodyIsNothingToRemove) {
  tracks.clear();
  EXPECT_FALSE(on_person(120.0F, 160.0F, 2.0F));
  EXPECT_FALSE(on_person(120.0F, 160.0F, 0.0F));
  EXPECT_TRUE(find_keypoints_on_people(camera, depth_m, tracks, 0.0, {}).empty());
}

TEST(KeypointFilter, TellsAPersonFromTheRoomAllOver) {
  const GridCamera camera = scene::grid_camera();
  const View view = DepthScene()
                        .wall(4.5F)
                        .floor()
                        .person({1, {-0.4F, scene::kCameraHeightM, 2.6F}})
                        .person({2, {0.5F, scene::kCameraHeightM, 3.2F}})
                        .look(camera);
  const std::vector<PersonTrack> tracks{scene::track_of(view, 1), scene::track_of(view, 2)};
  const std::vector<DepthKeypoint> keypoints = scene::keypoints_on(view, 1);
  const auto marks = find_keypoints_on_people(camera, view.depth_m, tracks, 0.0, keypoints);
  int missed = 0, lost = 0, people = 0;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const bool person = view.owner(camera.cell_of_pixel(keypoints[i].x, keypoints[i].y)) != 0;
    people += person ? 1 : 0;
    missed += person && marks[i] == 0 ? 1 : 0;
    lost += !person && marks[i] != 0 ? 1 : 0;
  }
  EXPECT_EQ(missed, 0);
  EXPECT_LT(lost, people / 20);
}

TEST(KeypointsInBoxes, AreAllThatIsInside) {
  const std::vector<PersonBox> boxes{{10.0, 20.0, 30.0, 40.0}, {100.0, 100.0, 5.0, 5.0}};
  const std::vector<DepthKeypoint> keypoints{{10.0F, 20.0F, 1.0F}, {39.9F, 59.9F, 0.0F},
                                             {40.0F, 30.0F, 1.0F}, {9.9F, 30.0F, 1.0F},
                                             {20.0F, 60.0F, 2.0F}, {102.0F, 102.0F, 7.0F}};
  EXPECT_EQ(marked(find_keypoints_in_boxes(boxes, keypoints)), (std::vector<int>{0, 1, 5}));
  EXPECT_TRUE(marked(find_keypoints_in_boxes({}, keypoints)).empty());
}

class PublishedFilterTest : public testing::Test {
 protected:
  void add(int n, float depth_m, float x = 50.0F) {
    for (int i = 0; i < n; ++i) keypoints.push_back({x, 50.0F, depth_m});
  }
  std::vector<int> run(std::uint64_t seed = 1) const {
    Random random(seed);
    return marked(find_keypoints_as_published(boxes, keypoints, random));
  }
  std::vector<PersonBox> boxes{{0.0, 0.0, 100.0, 100.0}};
  std::vector<DepthKeypoint> keypoints;
};

std::vector<int> first(int n) {
  std::vector<int> indices(std::size_t(n), 0);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

TEST_F(PublishedFilterTest, RemovesTheLargestSetThatAgrees) {
  add(30, 2.0F);
  add(8, 4.0F);
  for (std::uint64_t seed = 0; seed < 10; ++seed) EXPECT_EQ(run(seed), first(30));
}

TEST_F(PublishedFilterTest, ItsThresholdGrowsFromTwoToFourCentimetres) {
  // Formula (6). From the middle both halves are 2.5 cm off: outside until one half has agreed, and then in.
  add(30, 2.0F);
  add(30, 2.05F);
  int all = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) all += run(seed) == first(60) ? 1 : 0;
  EXPECT_GE(all, 18);
  // 4.5 cm off they are never in.
  for (std::size_t i = 30; i < 60; ++i) keypoints[i].depth_m = 2.09F;
  for (std::uint64_t seed = 0; seed < 20; ++seed) EXPECT_EQ(run(seed).size(), 30U);
}

TEST_F(PublishedFilterTest, FewThatAgreeHaveTheNarrowThreshold) {
  // Ten depths 10 cm apart agree with nothing but themselves.
  for (int i = 0; i < 10; ++i) add(1, 1.0F + 0.1F * float(i));
  EXPECT_LE(run().size(), 2U);
}

TEST_F(PublishedFilterTest, ASingleKeypointOfABoxIsThePersons) {
  add(1, 3.0F);
  EXPECT_EQ(run(), first(1));
}

TEST_F(PublishedFilterTest, KeypointsWithoutDepthStay) {
  add(5, 0.0F);
  EXPECT_TRUE(run().empty());
  add(1, 2.0F);
  EXPECT_EQ(run(), std::vector<int>{5});
}

TEST_F(PublishedFilterTest, EqualDepthsAllGo) {
  add(25, 2.5F);
  EXPECT_EQ(run(), first(25));
}

TEST_F(PublishedFilterTest, KeypointsOutsideTheBoxesPlayNoPart) {
  add(4, 2.0F);
  add(40, 3.0F, 200.0F);
  EXPECT_EQ(run(), first(4));
}

TEST_F(PublishedFilterTest, JudgesEveryBoxByItself) {
  boxes.push_back({150.0, 0.0, 100.0, 100.0});
  add(20, 2.0F);
  add(20, 3.0F, 200.0F);
  EXPECT_EQ(run(), first(40));
  boxes.clear();
  EXPECT_TRUE(run().empty());
}

TEST_F(PublishedFilterTest, IsTheSameForTheSameSeed) {
  Random random(9);
  for (int i = 0; i < 60; ++i) add(1, float(random.uniform(1.0, 4.0)));
  EXPECT_EQ(run(4), run(4));
}

}  // namespace
}  // namespace cpslam
