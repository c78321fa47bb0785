#include "cpslam/dense_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cpslam/error.h"
#include "dense/dense_map_impl.h"
#include "dense/flat_scene.h"
#include "io/temporary_folder.h"

namespace cpslam {
namespace {

/// Of views of a wall at 2 m, each moved a little, with a sensor's noise.
class DenseMapTest : public testing::Test {
 protected:
  DenseMapTest() {
    Random random(5);
    for (int i = 0; i < 4; ++i) {
      const SE3 world_from_view(so3_exp({0.0, 0.03 * i, 0.0}), {0.1 * i, 0.0, -0.05 * i});
      DenseFrame frame = flat::look(pinhole_, {wall_}, world_from_view);
      flat::disturb(0.006, random, frame);
      views_.push_back(flat::place(*camera_, frame, world_from_view));
    }
  }
  [[nodiscard]] DenseMap make(const DenseMapOptions& options = {}) const {
    return DenseMap(std::make_unique<const DenseMap::Impl>(options, camera_, views_, 0));
  }

  const PinholeCamera pinhole_ = flat::camera();
  const std::shared_ptr<const DenseCamera> camera_ = std::make_shared<const DenseCamera>(pinhole_);
  const flat::Plane wall_ = flat::wall(2.0);
  std::vector<PlacedView> views_;
};

TEST_F(DenseMapTest, ANoisyWallIsOneLayerOfPoints) {
  const DenseMap map = make();
  EXPECT_EQ(map.n_views(), 4U);
  ASSERT_GT(map.points().size(), 8'000U);
  double squares = 0.0;
  std::set<std::pair<long, long>> columns;
  for (const CloudPoint& point : map.points()) {
    const auto& [x, y, z] = point.position_m;
    squares += std::pow(z - 2.0F, 2);
    EXPECT_NEAR(z, 2.0F, 0.02F);
    EXPECT_LT(point.normal[2], -0.95F);
    EXPECT_EQ(point.rgb, wall_.rgb);
    columns.emplace(std::lround(std::floor(x / 0.02F)), std::lround(std::floor(y / 0.02F)));
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(map.points().size())), 0.003);
  // A mean may lie in the next column, hardly more.
  EXPECT_GT(static_cast<double>(columns.size()), 0.9 * static_cast<double>(map.points().size()));
}

TEST_F(DenseMapTest, LargerVoxelsGiveFewerPointsAndNothingIsFartherThanWanted) {
  const std::size_t fine = make({0.02, 4.0}).points().size();
  const std::size_t coarse = make({0.04, 4.0}).points().size();
  EXPECT_NEAR(static_cast<double>(fine) / static_cast<double>(coarse), 4.0, 0.6);
  EXPECT_TRUE(make({0.02, 1.5}).points().empty());
}

TEST_F(DenseMapTest, IsTheSameEveryTime) {
  const DenseMap a = make(), b = make();
  ASSERT_EQ(a.points().size(), b.points().size());
  for (std::size_t i = 0; i < a.points().size(); ++i) {
    ASSERT_EQ(a.points()[i].position_m, b.points()[i].position_m);
    ASSERT_EQ(a.points()[i].normal, b.points()[i].normal);
    ASSERT_EQ(a.points()[i].rgb, b.points()[i].rgb);
  }
}

TEST_F(DenseMapTest, OfNoViewsIsEmptyAndCanBeSaved) {
  views_.clear();
  const TemporaryFolder folder;
  const DenseMap map = make();
  EXPECT_TRUE(map.points().empty());
  map.save_cloud(folder.file("a.ply"));
  if (DenseMap::can_save_octomap()) map.save_octomap(folder.file("a.bt"));
}

TEST_F(DenseMapTest, OptionsOutOfRangeAreRefused) {
  const double kNan = std::nan("");
  for (const DenseMapOptions& options : {DenseMapOptions{0.0, 4.0}, DenseMapOptions{kNan, 4.0},
                                         DenseMapOptions{0.02, 14.0}, DenseMapOptions{-1.0, 4.0}})
    EXPECT_THROW(static_cast<void>(make(options)), InputError);
  const DenseMap map = make();
  EXPECT_THROW(map.save_octomap("a.bt", 0.0), InputError);
  EXPECT_THROW(map.save_octomap("a.bt", kNan), InputError);
}

}  // namespace
}  // namespace cpslam
