#include "dense/carving.h"

#include <gtest/gtest.h>

#include "dense/flat_scene.h"
#include "dense/surface.h"

namespace cpslam {
namespace {

constexpr float kSideM = 0.02F;

class Carving : public testing::Test {
 protected:
  void see(const std::vector<flat::Plane>& planes, const cv::Rect& covered = {}) {
    DenseFrame frame = flat::look(pinhole_, planes);
    if (!covered.empty()) {
      frame.moving = cv::Mat1b(480, 640, std::uint8_t{0});
      frame.moving(covered).setTo(255);
    }
    views_.push_back(flat::place(camera_, frame));
    for (const SurfacePoint& point : surface_points(camera_, *views_.back().view, 5.0F))
      grid_.add(point.position_m.cast<double>(), point.normal, {}, point.weight);
  }
  /// How many voxels are before the wall, and how many in it, after carving.
  [[nodiscard]] std::pair<int, int> count() const {
    std::pair<int, int> counts;
    for (const Voxel& voxel : carve(grid_.voxels(), kSideM, camera_, views_))
      ++(voxel.position_m.z() < 2.5F ? counts.first : counts.second);
    return counts;
  }

  const PinholeCamera pinhole_ = flat::camera();
  const DenseCamera camera_{pinhole_};
  const flat::Plane wall_ = flat::wall(3.0);
  const flat::Plane board_ = flat::board(1.5, 0.3);
  VoxelGrid grid_{kSideM};
  std::vector<PlacedView> views_;
};

TEST_F(Carving, WhatAllViewsSeeStays) {
  for (int i = 0; i < 3; ++i) see({wall_, board_});
  const auto [board, wall] = count();
  EXPECT_GT(board, 700);
  EXPECT_GT(wall, 10'000);
  EXPECT_EQ(static_cast<std::size_t>(board + wall), grid_.voxels().size());
}

TEST_F(Carving, WhatALaterViewSeesThroughIsGone) {
  see({wall_, board_});
  see({wall_});
  const auto [board, wall] = count();
  EXPECT_EQ(board, 0);
  // Nothing said that the wall is not there, before and behind.
  see({wall_, board_});
  EXPECT_GE(count().second, wall);
  EXPECT_GT(wall, 15'000);
}

TEST_F(Carving, OneViewAgainstManyDoesNotCarve) {
  for (int i = 0; i < 6; ++i) see({wall_, board_});
  see({wall_});
  EXPECT_GT(count().first, 700);
  see({wall_});
  see({wall_});
  EXPECT_EQ(count().first, 0) << "but half as many do";
}

TEST_F(Carving, WhereSomebodyStandsInTheWayNothingIsSeenThrough) {
  see({wall_, board_});
  see({wall_}, {0, 0, 640, 480});
  EXPECT_GT(count().first, 700);
}

TEST_F(Carving, ViewsFromBehindSayNothing) {
  see({wall_, board_});
  DenseFrame frame = flat::look(pinhole_, {flat::wall(8.0)});
  views_.push_back(flat::place(camera_, frame, SE3(Eigen::Matrix3d::Identity(), {0.0, 0.0, 3.5})));
  EXPECT_GT(count().first, 700);
}

TEST_F(Carving, ThinThingsStay) {
  // A pole of 6 mm, seen in a block here and in the next one there.
  flat::Plane pole = board_;
  for (int i = 0; i < 4; ++i) {
    pole.within = Eigen::AlignedBox3d(Eigen::Vector3d(0.003 * i, -0.5, 1.4),
                                      Eigen::Vector3d(0.003 * i + 0.006, 0.5, 1.6));
    see({wall_, pole});
  }
  VoxelGrid poles(kSideM);
  for (double y = -0.4; y < 0.4; y += 0.02) poles.add({0.006, y, 1.5}, {0.0F, 0.0F, -1.0F}, {}, 1.0F);
  const std::vector<Voxel> voxels = poles.voxels();
  EXPECT_EQ(carve(voxels, kSideM, camera_, views_).size(), voxels.size());
}

}  // namespace
}  // namespace cpslam
