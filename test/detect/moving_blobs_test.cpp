#include "detect/moving_blobs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "detect/depth_scene.h"

namespace cpslam {
namespace {

/// A wall at 4 m that has stood still for long.
class MovingBlobsTest : public testing::Test {
 protected:
  void arrive(const cv::Rect& where, float depth) {
    depth_m(where).setTo(depth);
    still_age(where).setTo(0);
  }
  [[nodiscard]] std::vector<GridSurface> find() const {
    return find_moving_blobs(depth_m, still_age, people, rim_cells);
  }

  cv::Mat1f depth_m = cv::Mat1f(120, 160, 4.0F);
  cv::Mat1b still_age = cv::Mat1b(120, 160, std::uint8_t{100});
  cv::Mat1b people = cv::Mat1b(120, 160, std::uint8_t{0});
  int rim_cells = 1;
  cv::Rect place{50, 30, 20, 50};
};

TEST_F(MovingBlobsTest, WhatHasArrivedMoves) {
  arrive(place, 2.0F);
  const std::vector<GridSurface> blobs = find();
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_EQ(int(blobs[0].size()), place.area());
  EXPECT_EQ(blobs[0].cells.size(), blobs[0].depth_m.size());
  for (std::size_t i = 0; i < blobs[0].size(); ++i) {
    EXPECT_TRUE(place.contains({blobs[0].cells[i] % 160, blobs[0].cells[i] / 160}));
    EXPECT_EQ(blobs[0].depth_m[i], 2.0F);
  }
}

TEST_F(MovingBlobsTest, TwoAtDifferentDepthsAreTwo) {
  arrive(place, 2.0F);
  arrive({70, 30, 20, 50}, 3.0F);
  EXPECT_EQ(find().size(), 2U);
}

TEST_F(MovingBlobsTest, WhatIsStillOrUnknownDoesNotMove) {
  EXPECT_TRUE(find().empty());
  depth_m(place).setTo(2.0F);
  EXPECT_TRUE(find().empty());
  still_age.setTo(StillSurface::kUnknownAge);
  EXPECT_TRUE(find().empty());
}

TEST_F(MovingBlobsTest, RimsThatAQuickCameraLeavesAreNobody) {
  const cv::Rect rim{50, 30, 8, 50};
  arrive(rim, 2.0F);
  EXPECT_EQ(find().size(), 1U);
  rim_cells = 4;
  EXPECT_TRUE(find().empty());
  arrive(place, 2.0F);
  ASSERT_EQ(find().size(), 1U) << "he is wider than a rim";
  EXPECT_EQ(int(find()[0].size()), place.area()) << "and keeps his own";
}

TEST_F(MovingBlobsTest, WhomSomebodyKnowsIsNoNews) {
  arrive(place, 2.0F);
  people(place).setTo(3);
  EXPECT_TRUE(find().empty());
}

TEST_F(MovingBlobsTest, ThinRimsAndSpecksDoNotCount) {
  arrive({20, 10, 1, 100}, 2.0F);
  arrive({30, 10, 2, 100}, 2.0F);
  arrive({80, 50, 3, 3}, 2.0F);
  EXPECT_TRUE(find().empty());
}

TEST_F(MovingBlobsTest, NothingWithoutDepth) {
  arrive(place, 0.0F);
  EXPECT_TRUE(find().empty());
}

TEST(MovingBlobs, FindWhoWalksIntoARoom) {
  const GridCamera camera = scene::grid_camera();
  const scene::DepthScene room = scene::DepthScene().wall(4.0F).floor().person(
      {1, {-2.2F, scene::kCameraHeightM, 2.5F}, {1.0F, 0.0F, 0.0F}});
  Random random(1);
  StillSurface still = StillSurface::begin(room.look(camera).depth_m);
  double best = 0.0;
  for (int i = 1; i <= 60; ++i) {
    scene::View view = room.look(camera, SE3(), i / 30.0);
    scene::add_noise(view, random);
    still = still.carry(camera, view.depth_m, SE3());
    const std::vector<GridSurface> blobs = find_moving_blobs(view.depth_m, still.age, scene::blank(view), 1);
    const std::vector<int> his = scene::cells_of(view, 1);
    for (const GridSurface& blob : blobs) {
      const auto on_him =
          std::count_if(blob.cells.begin(), blob.cells.end(), [&](int c) { return view.owner(c) == 1; });
      EXPECT_GT(double(on_him), 0.7 * double(blob.size())) << i;
      best = std::max(best, scene::overlap(blob.cells, his));
    }
  }
  EXPECT_GT(best, 0.4);
}

}  // namespace
}  // namespace cpslam
