#include "features/quadtree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "util/random.h"

namespace cpslam {
namespace {

constexpr auto kRasterOrder = [](const Corner& a, const Corner& b) {
  return std::tie(a.y, a.x) < std::tie(b.y, b.x);
};

std::vector<Corner> random_corners(const cv::Rect& region, std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::set<std::pair<int, int>> used;
  std::vector<Corner> corners;
  while (corners.size() < n) {
    const Corner c{region.x + static_cast<int>(random.index(static_cast<std::size_t>(region.width))),
                   region.y + static_cast<int>(random.index(static_cast<std::size_t>(region.height))),
                   static_cast<int>(random.index(100))};
    if (used.insert({c.x, c.y}).second) corners.push_back(c);
  }
  std::sort(corners.begin(), corners.end(), kRasterOrder);
  return corners;
}

TEST(Quadtree, GivesExactlyAsManyAsWanted) {
  for (const cv::Rect& region : {cv::Rect(19, 19, 600, 440), cv::Rect(19, 19, 50, 400),
                                 cv::Rect(19, 19, 300, 20), cv::Rect(19, 19, 282, 162)}) {
    for (const int wanted : {1, 2, 7, 50, 217}) {
      std::vector<Corner> corners = random_corners(region, 800, 1);
      const std::vector<Corner> all = corners;
      Quadtree().distribute(region, wanted, corners);
      EXPECT_EQ(corners.size(), static_cast<std::size_t>(wanted));
      std::set<std::pair<int, int>> places;
      for (const Corner& c : corners) {
        EXPECT_TRUE(std::binary_search(all.begin(), all.end(), c, kRasterOrder));
        places.insert({c.x, c.y});
      }
      EXPECT_EQ(places.size(), corners.size()) << "a corner came twice";
    }
  }
}

TEST(Quadtree, KeepsAllWhenThereAreTooFew) {
  const cv::Rect region(19, 19, 600, 440);
  std::vector<Corner> corners = random_corners(region, 40, 2);
  Quadtree().distribute(region, 50, corners);
  EXPECT_EQ(corners.size(), 40U);
  Quadtree().distribute(region, 0, corners);
  EXPECT_TRUE(corners.empty());
}

TEST(Quadtree, SpreadsOverQuartersAndTakesTheStrongestOfEach) {
  // Three corners crowd in each quarter of a square; the wanted four are the strongest of each, worked out by
  // hand.
  std::vector<Corner> corners{{20, 20, 5}, {21, 20, 9}, {70, 20, 1},  {72, 20, 2},
                              {22, 21, 7}, {74, 21, 3}, {20, 80, 50}, {22, 80, 60},
                              {80, 80, 8}, {82, 80, 8}, {20, 82, 70}, {80, 82, 8}};
  Quadtree().distribute(cv::Rect(0, 0, 100, 100), 4, corners);
  std::sort(corners.begin(), corners.end(), kRasterOrder);
  const std::vector<int> expected_x{21, 74, 80, 20};
  const std::vector<int> expected_y{20, 21, 80, 82};  // among equals the first in raster order
  ASSERT_EQ(corners.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(corners[i].x, expected_x[i]);
    EXPECT_EQ(corners[i].y, expected_y[i]);
  }
}

TEST(Quadtree, DoesNotLetACrowdTakeEverything) {
  // 500 strong corners in one corner of the image, 30 weak ones spread over the rest: the weak ones survive.
  std::vector<Corner> corners = random_corners(cv::Rect(19, 19, 60, 60), 500, 3);
  for (Corner& c : corners) c.response += 100;
  for (Corner c : random_corners(cv::Rect(200, 150, 400, 300), 30, 4)) corners.push_back({c.x, c.y, 8});
  std::sort(corners.begin(), corners.end(), kRasterOrder);
  Quadtree().distribute(cv::Rect(19, 19, 602, 442), 100, corners);
  const auto n_weak =
      std::count_if(corners.begin(), corners.end(), [](const Corner& c) { return c.response == 8; });
  EXPECT_GE(n_weak, 25);
}

TEST(Quadtree, IsTheSameOnReuse) {
  const cv::Rect region(19, 19, 600, 440);
  Quadtree tree;
  std::vector<Corner> first = random_corners(region, 800, 5);
  tree.distribute(region, 200, first);
  std::vector<Corner> other = random_corners(cv::Rect(19, 19, 100, 90), 300, 6);
  tree.distribute(cv::Rect(19, 19, 100, 90), 20, other);
  std::vector<Corner> second = random_corners(region, 800, 5);
  tree.distribute(region, 200, second);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].x, second[i].x);
    EXPECT_EQ(first[i].y, second[i].y);
  }
}

}  // namespace
}  // namespace cpslam
