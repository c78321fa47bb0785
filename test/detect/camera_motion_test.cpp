#include "detect/camera_motion.h"

#include <gtest/gtest.h>

#include "detect/depth_scene.h"
#include "support/synthetic.h"

namespace cpslam {
namespace {

/// A room of points and somebody in it, seen twice by a camera that moves as nobody expected.
class CameraMotionTest : public testing::Test {
 protected:
  /// `n` points in a part of the image (px), moved by step_m themselves, seen with noise.
  void add_points(int n, const cv::Rect& px, const Eigen::Vector3d& step_m = Eigen::Vector3d::Zero()) {
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector2d was(random_.uniform(px.x, px.br().x), random_.uniform(px.y, px.br().y));
      const Eigen::Vector3d point = camera_.camera().back_project(was, random_.uniform(1.5, 4.0));
      const Eigen::Vector3d moved = this_from_previous_ * point + step_m;
      const Eigen::Vector2d now = camera_.camera().project(moved);
      const Descriptor look = synthetic::random_descriptor(random_);
      add(previous_, was, point.z(), look);
      add(current_, now + 0.5 * Eigen::Vector2d(random_.normal(), random_.normal()),
          moved.z() + 0.005 * random_.normal(), synthetic::flipped(look, 10, 0));
    }
  }
  static void add(FlowKeypoints& keypoints, const Eigen::Vector2d& px, double depth_m,
                  const Descriptor& look) {
    keypoints.keypoints.push_back({float(px.x()), float(px.y()), float(depth_m)});
    keypoints.descriptors.push_back(look);
  }
  [[nodiscard]] std::optional<SE3> measure() const {
    return measure_camera_motion(camera_, previous_, people_, current_, expected_);
  }
  void expect_found(const std::optional<SE3>& found) const {
    ASSERT_TRUE(found);
    const SE3 error = *found * this_from_previous_.inverse();
    EXPECT_LT(error.translation.norm(), 0.004);
    EXPECT_LT(rotation_angle(error.rotation), 0.002);
  }

  const cv::Rect kImage{20, 20, 600, 440};
  Random random_{7};
  GridCamera camera_ = scene::grid_camera();
  cv::Mat1b people_ = cv::Mat1b(120, 160, std::uint8_t{0});
  FlowKeypoints previous_, current_;
  SE3 this_from_previous_{so3_exp({0.005, -0.03, 0.004}), {0.02, -0.01, 0.03}};
  SE3 expected_;
};

TEST_F(CameraMotionTest, FindsATurnThatNobodyExpected) {
  add_points(300, kImage);
  expect_found(measure());
}

TEST_F(CameraMotionTest, ThinsOutManyKeypoints) {
  add_points(2000, kImage);
  expect_found(measure());
}

TEST_F(CameraMotionTest, DoesNotAskPeople) {
  add_points(100, kImage);
  const cv::Rect person(200, 40, 240, 400);
  add_points(400, person, {0.06, 0.0, 0.0});
  EXPECT_FALSE(measure().has_value() &&
               (*measure() * this_from_previous_.inverse()).translation.norm() < 0.004)
      << "as long as he is not known he must spoil it, or this test proves nothing";
  people_(cv::Rect(person.x / 4, person.y / 4, person.width / 4, person.height / 4)).setTo(1);
  expect_found(measure());
}

TEST_F(CameraMotionTest, StandsSomebodyNotKnownIfHeIsInTheMinority) {
  add_points(300, kImage);
  add_points(120, {200, 40, 240, 400}, {0.06, 0.0, 0.0});
  expect_found(measure());
}

TEST_F(CameraMotionTest, SaysNothingWhenFewAgree) {
  EXPECT_FALSE(measure());
  add_points(20, kImage);
  EXPECT_FALSE(measure()) << "too few";
  for (int i = 0; i < 12; ++i)
    add_points(10, kImage,
               {random_.uniform(-0.1, 0.1), random_.uniform(-0.1, 0.1), random_.uniform(-0.2, 0.2)});
  EXPECT_FALSE(measure()) << "most move, each its own way";
}

TEST_F(CameraMotionTest, LeavesOutKeypointsWithoutDepth) {
  add_points(300, kImage);
  for (DepthKeypoint& k : previous_.keypoints) k.depth_m = 0.0F;
  EXPECT_FALSE(measure());
}

}  // namespace
}  // namespace cpslam
