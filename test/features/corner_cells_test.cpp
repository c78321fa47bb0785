#include "features/corner_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>

#include "features/corner_detector.h"
#include "features/image_pyramid.h"
#include "test_images.h"

namespace cpslam {
namespace {

constexpr auto kPlace = [](const Corner& c) { return std::tuple(c.y, c.x, c.response); };

std::vector<std::tuple<int, int, int>> places_of(const std::vector<Corner>& corners) {
  std::vector<std::tuple<int, int, int>> places;
  std::transform(corners.begin(), corners.end(), std::back_inserter(places), kPlace);
  return places;
}

TEST(CornerCells, WeakCornersComeOnlyFromCellsWithoutStrongOnes) {
  ImagePyramid pyramid(1.2, 1);
  pyramid.build(test::textured_image(320, 240, 5));
  std::vector<Corner> all;
  CornerDetector(7).detect(pyramid.level(0), all);
  // 282 x 202 px inside the border: 9 x 6 cells of 32 x 34 px.
  const auto cell = [](const Corner& c) {
    return std::min((c.y - 19) / 34, 5) * 9 + std::min((c.x - 19) / 32, 8);
  };
  std::set<int> strong_cells;
  std::size_t n_strong = 0;
  for (const Corner& c : all) {
    if (c.response < 20) continue;
    strong_cells.insert(cell(c));
    ++n_strong;
  }
  std::vector<Corner> expected;
  std::vector<Corner> expected_weak;
  for (const Corner& c : all)
    (c.response >= 20 || !strong_cells.contains(cell(c)) ? expected : expected_weak).push_back(c);
  ASSERT_GT(expected.size(), n_strong) << "the picture has no cell with weak corners only";
  ASSERT_FALSE(expected_weak.empty());

  CornerCells cells(20);
  cells.set_level({320, 240});
  std::vector<Corner> kept{{1, 2, 3}};
  std::vector<Corner> weak{{4, 5, 6}};
  cells.select(all, kept, &weak);
  EXPECT_EQ(places_of(kept), places_of(expected));
  EXPECT_EQ(places_of(weak), places_of(expected_weak));
  cells.select(all, kept, nullptr);
  EXPECT_EQ(places_of(kept), places_of(expected));
}

TEST(CornerCells, OnlyTheCornersGivenMakeACellStrong) {
  CornerCells cells(20);
  cells.set_level({68, 68});  // one cell
  std::vector<Corner> kept;
  std::vector<Corner> weak;
  const std::vector<Corner> all{{20, 20, 9}, {30, 25, 60}, {40, 40, 12}};
  cells.select(all, kept, &weak);
  EXPECT_EQ(places_of(kept), (std::vector{kPlace(all[1])}));
  EXPECT_EQ(places_of(weak), (std::vector{kPlace(all[0]), kPlace(all[2])}));
  const std::vector<Corner> without_the_strong{all[0], all[2]};
  cells.select(without_the_strong, kept, &weak);
  EXPECT_EQ(places_of(kept), places_of(without_the_strong));
  EXPECT_TRUE(weak.empty());
}

TEST(CornerCells, NothingGivesNothing) {
  CornerCells cells(20);
  cells.set_level({320, 240});
  std::vector<Corner> kept{{1, 2, 3}};
  std::vector<Corner> weak{{1, 2, 3}};
  cells.select({}, kept, &weak);
  EXPECT_TRUE(kept.empty());
  EXPECT_TRUE(weak.empty());
}

}  // namespace
}  // namespace cpslam
