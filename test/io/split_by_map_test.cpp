#include <gtest/gtest.h>

#include "cpslam/trajectory.h"

namespace cpslam {
namespace {

Trajectory of_maps(const std::vector<int>& maps) {
  Trajectory trajectory;
  for (const int map : maps) {
    StampedPose pose;
    pose.time_s = static_cast<double>(trajectory.size());
    pose.map = map;
    trajectory.push_back(pose);
  }
  return trajectory;
}

TEST(SplitByMap, TheLargestComesFirstAndOrderStays) {
  const std::vector<Trajectory> maps = split_by_map(of_maps({1, 1, 3, 3, 2, 3, 1, 3}));
  ASSERT_EQ(maps.size(), 3U);
  EXPECT_EQ(maps[0].size(), 4U);
  EXPECT_EQ(maps[0][0].map, 3);
  EXPECT_EQ(maps[0][0].time_s, 2.0);
  EXPECT_EQ(maps[0][3].time_s, 7.0);
  EXPECT_EQ(maps[1][0].map, 1);
  EXPECT_EQ(maps[1].back().time_s, 6.0);
  EXPECT_EQ(maps[2].size(), 1U);
}

TEST(SplitByMap, OfLikeOnesTheOlderComesFirst) {
  const std::vector<Trajectory> maps = split_by_map(of_maps({2, 2, 1, 1}));
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_EQ(maps[0][0].map, 1);
}

TEST(SplitByMap, NothingHasNoMaps) {
  EXPECT_TRUE(split_by_map({}).empty());
}

}  // namespace
}  // namespace cpslam
