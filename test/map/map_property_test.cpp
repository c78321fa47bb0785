// Random sequences of everything that can be done to a Map, checked against what must always hold.
#include <gtest/gtest.h>

#include "map/map_monkey.h"

namespace cpslam {
namespace {

void run(std::uint64_t seed, bool lonely) {
  test::Monkey monkey(seed, lonely);
  for (int step = 0; step < 4000; ++step) {
    SCOPED_TRACE("seed " + std::to_string(seed) + " step " + std::to_string(step));
    monkey.act();
    if (step % 10 == 0) {
      test::check_links(monkey.map);
      test::check_covisibility(monkey.map);
      test::check_tree(monkey.map, monkey.root, !lonely);
    }
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(monkey.culled.size(), 50U) << "the test must really cull";
  for (const KeyFrameId id : monkey.culled) {
    EXPECT_EQ(monkey.map.keyframe(id), nullptr);
    EXPECT_NE(monkey.map.keyframe(monkey.map.living(id)), nullptr);
    EXPECT_TRUE(monkey.map.cam_from_world(id).has_value());
  }
}

TEST(MapProperty, RandomOperationsKeepTheMapConsistent) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) run(seed, false);
}

TEST(MapProperty, SoTheyDoWithKeyFramesThatShareNothing) {
  for (std::uint64_t seed = 10; seed < 16; ++seed) run(seed, true);
}

}  // namespace
}  // namespace cpslam
