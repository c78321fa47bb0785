#include "slam/place_evidence.h"

#include <gtest/gtest.h>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

/// A frame right where a mapped keyframe was: every keypoint belongs to a point.
class Evidence : public testing::Test {
 protected:
  Evidence() {
    local_map_.centre_on(mapped_.map, mapped_.keyframes[0]);
    frame_ = mapped_.frame_at({}, {}, random_);
  }
  /// Matches the frame's first n keypoints.
  void match(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) frame_.matches[i].kind = PointMatch::Kind::kMapPoint;
  }
  /// What a frame sees that has its keypoints at the same places, with other depths.
  template <typename NewDepth>
  void change_depths(NewDepth new_depth_m) {
    std::vector<synthetic::Spot> spots;
    for (std::size_t i = 0; i < frame_.features->keypoints.size(); ++i) {
      const Keypoint& keypoint = frame_.features->keypoints[i];
      spots.push_back({.x = static_cast<double>(keypoint.x),
                       .y = static_cast<double>(keypoint.y),
                       .descriptor = {},
                       .depth_m = new_depth_m(keypoint, static_cast<double>(frame_.features->depth_m[i]))});
    }
    frame_.features = synthetic::make_features(spots);
    frame_.matches.assign(spots.size(), {});
  }
  [[nodiscard]] PlaceEvidence evidence() const { return place_evidence(kRig, local_map_, frame_); }

  Random random_{91};
  scene::MappedWorld mapped_{400, {SE3()}, {}, random_};
  LocalMap local_map_;
  Frame frame_;
};

TEST_F(Evidence, BothSharesGrowWithTheMatches) {
  EXPECT_DOUBLE_EQ(evidence().matched_share, 0.0);
  EXPECT_DOUBLE_EQ(evidence().found_share, 0.0);
  match(100);
  EXPECT_NEAR(evidence().matched_share, 0.25, 0.01);
  EXPECT_NEAR(evidence().found_share, 0.25, 0.01);
  match(400);
  EXPECT_DOUBLE_EQ(evidence().matched_share, 1.0);
  EXPECT_DOUBLE_EQ(evidence().found_share, 1.0);
}

TEST_F(Evidence, WhereNothingCanBeSeenNothingIsMissing) {
  // A person in front of the left two thirds: there are no keypoints, and half of the others are matched.
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
  match(spots.size() / 2);
  EXPECT_NEAR(evidence().found_share, 0.5, 0.08);
}

TEST_F(Evidence, TemporaryPointsAreNoMatches) {
  match(100);
  frame_.matches[200].kind = PointMatch::Kind::kTemporary;
  EXPECT_NEAR(evidence().matched_share, 0.25, 0.01);
}

TEST_F(Evidence, AtTheRightPlaceNothingIsSeenThrough) {
  EXPECT_LT(evidence().seen_through_share, 0.02);
}

TEST_F(Evidence, WhereTheMapHasSomethingAndTheFrameLooksFartherThatIsSeenThrough) {
  change_depths(
      [](const Keypoint& keypoint, double depth_m) { return keypoint.x < 320.0F ? depth_m + 1.0 : depth_m; });
  EXPECT_NEAR(evidence().seen_through_share, 0.5, 0.1);
  change_depths([](const Keypoint&, double depth_m) { return depth_m + 2.0; });
  EXPECT_GT(evidence().seen_through_share, 0.9);
}

TEST_F(Evidence, WhoStandsInFrontSaysNothingAgainstIt) {
  change_depths([](const Keypoint& keypoint, double depth_m) { return keypoint.x < 400.0F ? 0.6 : depth_m; });
  EXPECT_LT(evidence().seen_through_share, 0.03);
}

TEST_F(Evidence, TheNoiseOfDepthsSaysNothingAgainstIt) {
  change_depths([this](const Keypoint&, double depth_m) { return depth_m + 0.04 * random_.normal(); });
  EXPECT_LT(evidence().seen_through_share, 0.03);
}

TEST_F(Evidence, WithoutDepthsOrWithoutAMapThereIsNone) {
  change_depths([](const Keypoint&, double) { return 0.0; });
  EXPECT_DOUBLE_EQ(evidence().seen_through_share, 0.0);
  const PlaceEvidence nothing = place_evidence(kRig, LocalMap(), frame_);
  EXPECT_DOUBLE_EQ(nothing.matched_share, 0.0);
  EXPECT_DOUBLE_EQ(nothing.found_share, 0.0);
  EXPECT_DOUBLE_EQ(nothing.seen_through_share, 0.0);
}

/// matched, found, seen through
TEST(PlaceEvidence, HasToConvince) {
  EXPECT_TRUE((PlaceEvidence{0.44, 0.2, 0.16}.is_convincing()));   // things were moved since
  EXPECT_TRUE((PlaceEvidence{0.13, 0.32, 0.06}.is_convincing()));  // a corner of what is mapped
  EXPECT_TRUE((PlaceEvidence{0.25, 0.13, 0.05}.is_convincing()));  // among many points
  EXPECT_FALSE(
      (PlaceEvidence{0.33, 0.14, 0.15}.is_convincing()));  // another desk of the same kind, seen through
  EXPECT_FALSE((PlaceEvidence{0.34, 0.32, 0.17}.is_convincing()));  // at the map's rim
  EXPECT_FALSE((PlaceEvidence{0.13, 0.05, 0.02}.is_convincing()));  // and one that is not
}

}  // namespace
}  // namespace cpslam
