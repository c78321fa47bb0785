#include "detect/person_flow.h"

#include <gtest/gtest.h>

#include "detect/depth_scene.h"
#include "support/synthetic.h"

namespace cpslam {
namespace {

using synthetic::random_descriptor;

constexpr double kStepS = 1.0 / 30.0;

/// Points on a person and in the room, seen twice by a camera that moves.
class PersonFlowTest : public testing::Test {
 protected:
  PersonFlowTest() {
    tracks_.emplace_back();
    tracks_[0].number = 3;
    people_(kPlace).setTo(3);
  }

  /// `n` points inside the person's cells at about 2.5 m that move by velocity and look alike in both frames.
  void add_points(int n, const Eigen::Vector3d& velocity_m_per_s, int bit_flips = 10) {
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector2d px(random_.uniform(4.0 * kPlace.x + 10.0, 4.0 * kPlace.br().x - 10.0),
                               random_.uniform(4.0 * kPlace.y + 10.0, 4.0 * kPlace.br().y - 10.0));
      const Descriptor look = random_descriptor(random_);
      const Eigen::Vector3d point = camera_.camera().back_project(px, random_.uniform(2.4, 2.6));
      previous_.keypoints.push_back({float(px.x()), float(px.y()), float(point.z())});
      previous_.descriptors.push_back(look);
      const Eigen::Vector3d moved = this_from_previous_ * point + kStepS * velocity_m_per_s;
      const Eigen::Vector2d now = camera_.camera().project(moved);
      current_.keypoints.push_back({float(now.x()), float(now.y()), float(moved.z())});
      current_.descriptors.push_back(
          synthetic::flipped(look, bit_flips, int(random_.index(std::size_t(257 - bit_flips)))));
    }
  }
  void follow(double dt_s = kStepS) {
    follow_keypoints(camera_, previous_, people_, current_, this_from_previous_, dt_s, tracks_);
  }

  const cv::Rect kPlace{60, 20, 40, 80};
  Random random_{1};
  GridCamera camera_ = scene::grid_camera();
  cv::Mat1b people_ = cv::Mat1b(120, 160, std::uint8_t{0});
  FlowKeypoints previous_, current_;
  SE3 this_from_previous_;
  std::vector<PersonTrack> tracks_;
};

void expect_near(const Eigen::Vector3f& found, const Eigen::Vector3f& truth) {
  EXPECT_LT((found - truth).norm(), 0.1F * truth.norm()) << found.transpose() << " for " << truth.transpose();
}

/// Of a new track.
void expect_unmeasured(const PersonTrack& track) {
  EXPECT_EQ(track.velocity_m_per_s, PersonTrack{}.velocity_m_per_s);
  EXPECT_EQ(track.velocity_variance, PersonTrack{}.velocity_variance);
}

TEST_F(PersonFlowTest, MeasuresTheVelocity) {
  add_points(30, {1.2, 0.1, -0.5});
  follow();
  EXPECT_TRUE(is_walking(tracks_[0]));
  expect_near(tracks_[0].velocity_m_per_s, {1.2F, 0.1F, -0.5F});
}

TEST_F(PersonFlowTest, FreesItOfTheCamerasMotion) {
  this_from_previous_ = SE3(so3_exp({0.01, -0.02, 0.005}), {0.02, -0.01, 0.015});
  add_points(30, {-0.8, 0.0, 0.4});
  follow();
  expect_near(tracks_[0].velocity_m_per_s, {-0.8F, 0.0F, 0.4F});
}

TEST_F(PersonFlowTest, IgnoresOutliers) {
  add_points(30, {1.0, 0.0, 0.3});
  add_points(10, {-2.0, 1.0, 0.0});
  follow();
  expect_near(tracks_[0].velocity_m_per_s, {1.0F, 0.0F, 0.3F});
}

TEST_F(PersonFlowTest, BelievesNobodyWhenAllDisagree) {
  for (int i = 0; i < 24; ++i)
    add_points(1, {random_.uniform(-3.5, 3.5), random_.uniform(-3.5, 3.5), random_.uniform(-3.5, 3.5)});
  tracks_[0].velocity_m_per_s = {0.3F, 0.0F, 0.0F};
  follow();
  EXPECT_EQ(tracks_[0].velocity_m_per_s, Eigen::Vector3f(0.3F, 0.0F, 0.0F));
}

TEST_F(PersonFlowTest, APairOfMatchesChangesNothing) {
  add_points(2, {1.0, 0.0, 0.3});
  follow();
  expect_unmeasured(tracks_[0]);
  EXPECT_EQ(tracks_[0].velocity_m_per_s, Eigen::Vector3f::Zero());
}

TEST_F(PersonFlowTest, WhatLooksDifferentIsNoMatch) {
  add_points(30, {1.0, 0.0, 0.0}, 120);
  follow();
  expect_unmeasured(tracks_[0]);
}

TEST_F(PersonFlowTest, WhatLooksAlikeEverywhereIsNoMatch) {
  add_points(40, {1.0, 0.0, 0.0}, 0);
  for (Descriptor& d : previous_.descriptors) d = previous_.descriptors[0];
  for (Descriptor& d : current_.descriptors) d = previous_.descriptors[0];
  follow();
  expect_unmeasured(tracks_[0]);
}

TEST_F(PersonFlowTest, APatternThatRepeatsExactlyIsNoMatch) {
  // A shirt: the same look every 5 px, which fits its neighbours' places as well as its own.
  const Descriptor look = random_descriptor(random_);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      previous_.keypoints.push_back({float(300 + 5 * x), float(200 + 5 * y), 2.5F});
      previous_.descriptors.push_back(look);
    }
  }
  current_ = previous_;
  follow();
  expect_unmeasured(tracks_[0]);
}

TEST_F(PersonFlowTest, TheRoomsKeypointsPlayNoPart) {
  add_points(30, {1.0, 0.0, 0.0});
  people_.setTo(0);
  follow();
  expect_unmeasured(tracks_[0]);
}

TEST_F(PersonFlowTest, KeypointsWithoutDepthPlayNoPart) {
  add_points(30, {1.0, 0.0, 0.0});
  for (std::size_t i = 0; i < 30; ++i) (i % 2 == 0 ? previous_ : current_).keypoints[i].depth_m = 0.0F;
  follow();
  expect_unmeasured(tracks_[0]);
}

TEST_F(PersonFlowTest, ComesCloserToTheVelocityFrameByFrame) {
  tracks_[0].velocity_variance.setConstant(0.02F);
  tracks_[0].velocity_m_per_s = {0.4F, 0.0F, 0.0F};
  add_points(30, {1.0, 0.0, 0.0});
  float off = 0.6F;
  for (int i = 0; i < 6; ++i) {
    age_velocity(kStepS, tracks_[0]);
    follow();
    const float now = std::abs(tracks_[0].velocity_m_per_s.x() - 1.0F);
    EXPECT_LE(now, off + 1e-3F);
    off = now;
  }
  EXPECT_LT(off, 0.1F);
}

TEST_F(PersonFlowTest, TellsPeopleApart) {
  tracks_.emplace_back();
  tracks_[1].number = 7;
  add_points(20, {1.0, 0.0, 0.0});
  follow();
  EXPECT_TRUE(is_walking(tracks_[0]));
  expect_unmeasured(tracks_[1]);
  people_.setTo(7, people_ == 3);
  tracks_[0] = PersonTrack{};
  tracks_[0].number = 3;
  follow();
  expect_unmeasured(tracks_[0]);
  expect_near(tracks_[1].velocity_m_per_s, {1.0F, 0.0F, 0.0F});
}

TEST_F(PersonFlowTest, NoTimeIsNoVelocity) {
  add_points(30, {1.0, 0.0, 0.0});
  follow(0.0);
  EXPECT_EQ(tracks_[0].velocity_m_per_s, Eigen::Vector3f::Zero());
}

TEST_F(PersonFlowTest, NoKeypointsChangeNothing) {
  follow();
  expect_unmeasured(tracks_[0]);
}

}  // namespace
}  // namespace cpslam
