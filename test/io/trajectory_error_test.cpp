#include "io/trajectory_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/se3.h"
#include "util/random.h"

namespace cpslam {
namespace {

StampedPose at(double time_s, double x, double y, double z) {
  return {time_s, {{0.0, 0.0, 0.0, 1.0}, {x, y, z}}};
}

TEST(TrajectoryError, WorkedByHand) {
  // A square of side 2 whose estimated corners are pulled outwards: two opposite ones by 0.1, the others by
  // 0.3. The best alignment is the identity, so the errors are as pulled.
  const double d = std::sqrt(0.5);
  const Trajectory truth = {at(0, 1, 1, 0), at(1, -1, 1, 0), at(2, -1, -1, 0), at(3, 1, -1, 0)};
  const Trajectory estimate = {at(0, 1 + 0.1 * d, 1 + 0.1 * d, 0), at(1, -1 - 0.3 * d, 1 + 0.3 * d, 0),
                               at(2, -1 - 0.1 * d, -1 - 0.1 * d, 0), at(3, 1 + 0.3 * d, -1 - 0.3 * d, 0)};
  const TrajectoryError error = absolute_trajectory_error(truth, estimate);
  EXPECT_EQ(error.pairs, 4U);
  EXPECT_NEAR(error.rmse_m, std::sqrt((0.01 + 0.09) / 2.0), 1e-12);
  EXPECT_NEAR(error.mean_m, 0.2, 1e-12);
  EXPECT_NEAR(error.median_m, 0.2, 1e-12);
  EXPECT_NEAR(error.max_m, 0.3, 1e-12);
}

TEST(TrajectoryError, MedianOfAnOddCountIsTheMiddleOne) {
  // On a line, pulled by -1, 0 and +1 mm about the middle: errors 1, 0 and 1 mm.
  const Trajectory truth = {at(0, -1, 0, 0), at(1, 0, 0, 0), at(2, 1, 0, 0)};
  const Trajectory estimate = {at(0, -1.001, 0, 0), at(1, 0, 0, 0), at(2, 1.001, 0, 0)};
  const TrajectoryError error = absolute_trajectory_error(truth, estimate);
  EXPECT_NEAR(error.median_m, 0.001, 1e-12);
  EXPECT_NEAR(error.mean_m, 0.002 / 3.0, 1e-12);
}

TEST(TrajectoryError, ScaleIsNotAligned) {
  const Trajectory truth = {at(0, 1, 0, 0), at(1, -1, 0, 0), at(2, 0, 1, 0), at(3, 0, -1, 0)};
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) {
    for (double& t : pose.world_from_camera.translation_m) t *= 1.04;
  }
  EXPECT_NEAR(absolute_trajectory_error(truth, estimate).rmse_m, 0.04, 1e-12);
}

TEST(TrajectoryError, ARigidMoveOfTheEstimateIsNoError) {
  Random random(4);
  for (int round = 0; round < 20; ++round) {
    Eigen::Matrix<double, 6, 1> twist;
    for (int i = 0; i < 6; ++i) twist[i] = random.uniform(-2.0, 2.0);
    const SE3 move = SE3::exp(twist);
    Trajectory truth;
    Trajectory estimate;
    for (int i = 0; i < 40; ++i) {
      const Eigen::Vector3d p(random.normal(), random.normal(), random.normal());
      const Eigen::Vector3d q = move * p;
      truth.push_back(at(i, p.x(), p.y(), p.z()));
      estimate.push_back(at(i + random.uniform(-0.019, 0.019), q.x(), q.y(), q.z()));
    }
    const TrajectoryError error = absolute_trajectory_error(truth, estimate);
    EXPECT_EQ(error.pairs, 40U);
    EXPECT_LT(error.max_m, 1e-12);
    const std::optional<SE3> found = align_to_estimate(truth, estimate);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT((found->inverse() * move).log().norm(), 1e-9);
  }
}

TEST(TrajectoryError, FewerThanThreePairsHaveNoError) {
  const Trajectory truth = {at(0, 0, 0, 0), at(1, 1, 0, 0), at(2, 2, 5, 0)};
  const Trajectory estimate = {at(0, 0, 0, 0), at(1.01, 1, 0, 0), at(2.02001, 2, 0, 0)};
  const TrajectoryError error = absolute_trajectory_error(truth, estimate);
  EXPECT_EQ(error.pairs, 2U);
  EXPECT_EQ(error.rmse_m, 0.0);
  EXPECT_FALSE(align_to_estimate(truth, estimate).has_value());
  EXPECT_EQ(absolute_trajectory_error(truth, estimate, 0.03).pairs, 3U);
  EXPECT_GT(absolute_trajectory_error(truth, estimate, 0.03).rmse_m, 0.1);
  EXPECT_EQ(absolute_trajectory_error({}, {}).pairs, 0U);
}

}  // namespace
}  // namespace cpslam
