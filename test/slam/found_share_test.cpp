#include "slam/found_share.h"

#include <gtest/gtest.h>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

class FoundShare : public testing::Test {
 protected:
  FoundShare() {
    local_map_.centre_on(mapped_.map, mapped_.keyframes[0]);
    frame_ = mapped_.frame_at({}, {}, random_);
  }
  /// Matches the frame's first n keypoints.
  void find(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) frame_.matches[i].kind = PointMatch::Kind::kMapPoint;
  }

  Random random_{91};
  scene::MappedWorld mapped_{400, {SE3()}, {}, random_};
  LocalMap local_map_;
  Frame frame_;
};

TEST_F(FoundShare, GrowsWithWhatIsFound) {
  EXPECT_DOUBLE_EQ(found_share(kRig, local_map_, frame_), 0.0);
  find(100);
  EXPECT_NEAR(found_share(kRig, local_map_, frame_), 0.25, 0.01);
  find(400);
  EXPECT_NEAR(found_share(kRig, local_map_, frame_), 1.0, 0.01);
}

TEST_F(FoundShare, TemporaryPointsDoNotCount) {
  find(100);
  frame_.matches[200].kind = PointMatch::Kind::kTemporary;
  EXPECT_NEAR(found_share(kRig, local_map_, frame_), 0.25, 0.01);
}

TEST_F(FoundShare, WhereNothingCanBeSeenNothingIsMissing) {
  // A person in front of the left two thirds: there are no keypoints, and half of the others are found.
  std::vector<synthetic::Spot> spots;
  for (const Keypoint& keypoint : frame_.features->keypoints) {
    if (keypoint.x < 400.0F) continue;
    spots.push_back({.x = static_cast<double>(keypoint.x),
                     .y = static_cast<double>(keypoint.y),
                     .descriptor = {},
                     .depth_m = 2.0});
  }
  frame_.features = synthetic::make_features(spots);
  frame_.matches.assign(spots.size(), {});
  find(spots.size() / 2);
  EXPECT_NEAR(found_share(kRig, local_map_, frame_), 0.5, 0.08);
}

TEST_F(FoundShare, WithoutAMapNothingIsFound) {
  EXPECT_DOUBLE_EQ(found_share(kRig, LocalMap(), frame_), 0.0);
}

}  // namespace
}  // namespace cpslam
