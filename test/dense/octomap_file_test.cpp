#include "dense/octomap_file.h"

#include <gtest/gtest.h>

#include "cpslam/error.h"
#include "dense/flat_scene.h"
#include "io/temporary_folder.h"

#ifdef CPSLAM_HAS_OCTOMAP
#include <octomap/octomap.h>
#endif

namespace cpslam {
namespace {

#ifdef CPSLAM_HAS_OCTOMAP

TEST(OctomapFile, OctomapReadsOccupiedFreeAndUnknownSpace) {
  const PinholeCamera pinhole = flat::camera();
  const DenseCamera camera(pinhole);
  const std::vector<PlacedView> views{flat::place(camera, flat::look(pinhole, {flat::wall(2.02)}))};
  std::vector<CloudPoint> points;
  for (float x = -0.5F; x < 0.5F; x += 0.01F) {
    for (float y = -0.5F; y < 0.5F; y += 0.01F) points.push_back({{x, y, 2.02F}, {0.0F, 0.0F, -1.0F}, {}});
  }
  const TemporaryFolder folder;
  write_octomap(folder.file("a.bt"), 0.05, points, camera, views);

  octomap::OcTree tree(0.1);
  ASSERT_TRUE(tree.readBinary(folder.file("a.bt")));
  EXPECT_DOUBLE_EQ(tree.getResolution(), 0.05);
  const auto occupied = [&](double x, double y, double z) {
    return tree.isNodeOccupied(*tree.search(x, y, z));
  };
  for (const double x : {-0.4, 0.0, 0.4}) {
    ASSERT_NE(tree.search(x, 0.1, 2.02), nullptr);
    EXPECT_TRUE(occupied(x, 0.1, 2.02));
    for (const double z : {0.5, 1.0, 1.9}) {
      ASSERT_NE(tree.search(x * z / 2.0, 0.0, z), nullptr) << x << " " << z;
      EXPECT_FALSE(occupied(x * z / 2.0, 0.0, z));
    }
    EXPECT_EQ(tree.search(x, 0.1, 2.2), nullptr) << "nobody looked behind the wall";
  }
  EXPECT_EQ(tree.search(0.0, 0.0, -0.5), nullptr) << "nor behind the camera";
}

TEST(OctomapFile, OccupiedWinsOverRaysThatPassItsCell) {
  const PinholeCamera pinhole = flat::camera();
  const DenseCamera camera(pinhole);
  const std::vector<PlacedView> views{flat::place(camera, flat::look(pinhole, {flat::wall(3.0)}))};
  const std::vector<CloudPoint> points{{{0.01F, 0.01F, 1.01F}, {0.0F, 0.0F, -1.0F}, {}}};
  const TemporaryFolder folder;
  write_octomap(folder.file("a.bt"), 0.05, points, camera, views);
  octomap::OcTree tree(0.05);
  ASSERT_TRUE(tree.readBinary(folder.file("a.bt")));
  EXPECT_TRUE(tree.isNodeOccupied(*tree.search(0.01, 0.01, 1.01)));
}

TEST(OctomapFile, WhatCannotBeWrittenIsNamed) {
  EXPECT_THROW(write_octomap("/dev/full", 0.05, {}, DenseCamera(flat::camera()), {}), RunError);
}

#else

TEST(OctomapFile, WithoutOctomapItIsRefused) {
  EXPECT_FALSE(has_octomap());
  EXPECT_THROW(write_octomap("a.bt", 0.05, {}, DenseCamera(flat::camera()), {}), InputError);
}

#endif

}  // namespace
}  // namespace cpslam
