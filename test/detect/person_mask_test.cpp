#include "detect/person_mask.h"

#include <gtest/gtest.h>

#include <limits>

#include "detect/depth_grid.h"
#include "detect/depth_scene.h"

namespace cpslam {
namespace {

using scene::DepthScene;
using scene::View;

/// Two people before a wall, by pixel, and their tracks from the reduced depth.
class PersonMaskTest : public testing::Test {
 protected:
  PersonMaskTest() {
    const DepthScene room = DepthScene()
                                .wall(4.5F)
                                .person({1, {-0.4F, scene::kCameraHeightM, 2.0F}})
                                .person({2, {0.4F, scene::kCameraHeightM, 2.9F}});
    close = room.look_close(camera.camera());
    raw = scene::raw_depth(close);
    View grid = room.look(camera);
    grid.depth_m = reduce_depth(raw, 1.0 / scene::kUnitsPerM);
    // A cell is his whose surface its depth is.
    for (int y = 0; y < grid.owner.rows; ++y) {
      for (int x = 0; x < grid.owner.cols; ++x) {
        if (grid.depth_m(y, x) > 4.0F) grid.owner(y, x) = 0;
      }
    }
    tracks = {scene::track_of(grid, 1), scene::track_of(grid, 2)};
  }
  [[nodiscard]] double iou(const cv::Mat1b& mask, int number) const {
    const cv::Mat a = mask == number, b = close.owner == number;
    return double(cv::countNonZero(a & b)) / double(cv::countNonZero(a | b));
  }

  GridCamera camera = scene::grid_camera();
  View close;
  cv::Mat raw;
  std::vector<PersonTrack> tracks;
};

TEST_F(PersonMaskTest, FollowsTheOutlineByPixel) {
  const cv::Mat1b mask = person_mask(camera, tracks, raw, 1.0 / scene::kUnitsPerM);
  ASSERT_EQ(mask.size(), raw.size());
  EXPECT_GT(iou(mask, 1), 0.98);
  EXPECT_GT(iou(mask, 2), 0.98);
  // Whole cells would be off by more.
  const cv::Mat1b labels = paint_people(tracks, camera.size());
  cv::Mat1b cells(mask.size(), std::uint8_t{0});
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.cols; ++x) cells(y, x) = labels(y / kDepthCellPx, x / kDepthCellPx);
  }
  EXPECT_GT(iou(mask, 1), iou(cells, 1));
}

TEST_F(PersonMaskTest, ReadsBothKindsOfDepthImage) {
  cv::Mat floats;
  raw.convertTo(floats, CV_32F);
  const cv::Mat1b a = person_mask(camera, tracks, raw, 1.0 / scene::kUnitsPerM);
  const cv::Mat1b b = person_mask(camera, tracks, floats, 1.0 / scene::kUnitsPerM);
  EXPECT_EQ(cv::countNonZero(a != b), 0);
}

TEST_F(PersonMaskTest, PixelsWithoutDepthInHisCellsAreHis) {
  const cv::Point at(4 * (tracks[0].visible.cells[500] % 160) + 2,
                     4 * (tracks[0].visible.cells[500] / 160) + 2);
  raw.at<std::uint16_t>(at) = 0;
  EXPECT_EQ(person_mask(camera, tracks, raw, 1.0 / scene::kUnitsPerM)(at), 1);
  cv::Mat floats;
  raw.convertTo(floats, CV_32F);
  floats.at<float>(at) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(person_mask(camera, tracks, floats, 1.0 / scene::kUnitsPerM)(at), 1);
}

TEST_F(PersonMaskTest, BackgroundInHisCellsIsNotHis) {
  const cv::Point at(4 * (tracks[0].visible.cells[500] % 160) + 2,
                     4 * (tracks[0].visible.cells[500] / 160) + 2);
  raw.at<std::uint16_t>(at) = std::uint16_t(4.5 * scene::kUnitsPerM);
  EXPECT_EQ(person_mask(camera, tracks, raw, 1.0 / scene::kUnitsPerM)(at), 0);
}

TEST_F(PersonMaskTest, NobodyLeavesItEmpty) {
  const cv::Mat1b mask = person_mask(camera, {}, raw, 1.0 / scene::kUnitsPerM);
  EXPECT_EQ(mask.size(), raw.size());
  EXPECT_EQ(cv::countNonZero(mask), 0);
}

TEST_F(PersonMaskTest, SomebodyWhoIsHiddenHasNoPixels) {
  tracks.pop_back();
  tracks[0].visible.clear();
  EXPECT_EQ(cv::countNonZero(person_mask(camera, tracks, raw, 1.0 / scene::kUnitsPerM)), 0);
}

}  // namespace
}  // namespace cpslam
