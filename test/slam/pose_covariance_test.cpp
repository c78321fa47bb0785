// What track() says about how sure a pose is.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "cpslam/system.h"
#include "geometry/se3.h"
#include "sim/simulation.h"
#include "slam/simulated_frames.h"

namespace cpslam {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using test::SimulatedFrames;

Matrix6d to_matrix(const PoseCovariance& covariance) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(covariance.data());
}

TEST(TrackedPose, IsAsSureAsItsCovarianceSays) {
  // The same walk with ever other sensor noise; the map is made of the first frame as it happens to be noisy,
  // so the scatter is larger than what a frame alone accounts for.
  constexpr int kWalks = 16;
  constexpr std::size_t kFrames = 5;
  Matrix6d scatter = Matrix6d::Zero(), claimed = Matrix6d::Zero();
  for (int walk = 0; walk < kWalks; ++walk) {
    const SimulatedFrames frames(kFrames, "office_xyz", static_cast<std::uint64_t>(walk));
    System system(frames.with_mode(true));
    TrackResult result;
    for (std::size_t i = 0; i < kFrames; ++i) result = frames.track(system, i);
    ASSERT_EQ(result.state, TrackingState::kTracked);
    ASSERT_TRUE(result.covariance);
    const SE3 truth =
        frames.frames[0].world_from_camera.inverse() * frames.frames[kFrames - 1].world_from_camera;
    const Vector6d off = (from_pose(result.world_from_camera).inverse() * truth).log();
    scatter += off * off.transpose() / kWalks;
    claimed += to_matrix(*result.covariance) / kWalks;
  }
  const Vector6d ratio = (scatter.diagonal().array() / claimed.diagonal().array()).sqrt();
  EXPECT_GT(ratio.minCoeff(), 0.35);
  EXPECT_LT(ratio.maxCoeff(), 2.0);
}

TEST(TrackedPose, TheFirstFrameIsWhereTheWorldBegins) {
  const SimulatedFrames frames(2);
  System system(frames.with_mode(true));
  const TrackResult first = frames.track(system, 0);
  EXPECT_EQ(first.state, TrackingState::kTracked);
  ASSERT_TRUE(first.covariance);
  EXPECT_EQ(to_matrix(*first.covariance), Matrix6d::Zero());
  const TrackResult second = frames.track(system, 1);
  ASSERT_TRUE(second.covariance);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(to_matrix(*second.covariance)).eigenvalues().minCoeff(),
            0.0);
}

TEST(TrackedPose, IsVaguerWhereHalfThePictureIsCovered) {
  const SimulatedFrames frames(5);
  const auto last_trace = [&frames](bool covered) {
    System system(frames.with_mode(true));
    for (std::size_t i = 0; i < 4; ++i) (void)frames.track(system, i);
    cv::Mat colour = frames.frames[4].colour_bgr.clone();
    if (covered) colour.colRange(0, colour.cols / 2).setTo(cv::Scalar(40, 40, 40));
    const TrackResult result = system.track(colour, frames.frames[4].depth, frames.frames[4].time_s);
    EXPECT_TRUE(is_tracked(result.state));
    return to_matrix(result.covariance.value()).trace();
  };
  EXPECT_GT(last_trace(true), 1.2 * last_trace(false));
}

TEST(TrackedPose, IsWeakOnHardlyEnoughPoints) {
  const SimulatedFrames frames(6);
  int n_inliers = 1000000;
  {
    System system(frames.with_mode(true));
    for (std::size_t i = 0; i < 6; ++i) {
      const TrackResult result = frames.track(system, i);
      EXPECT_EQ(result.state, TrackingState::kTracked);
      n_inliers = std::min(n_inliers, result.n_inliers);
    }
    EXPECT_EQ(system.statistics().weak, 0U);
  }
  Settings strict = frames.with_mode(true);
  strict.tracking.min_inliers = static_cast<int>(0.8 * n_inliers);
  System system(strict);
  std::size_t weak = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const TrackResult result = frames.track(system, i);
    EXPECT_TRUE(is_tracked(result.state)) << i;
    const bool hardly = result.n_inliers < 2 * strict.tracking.min_inliers;
    EXPECT_EQ(result.state, hardly ? TrackingState::kWeak : TrackingState::kTracked) << i;
    weak += hardly ? 1U : 0U;
  }
  EXPECT_GT(weak, 0U);
  EXPECT_EQ(system.statistics().weak, weak);
  EXPECT_EQ(system.statistics().tracked, 6U) << "a weak pose is one";
  EXPECT_EQ(system.trajectory().size(), 6U);
}

TEST(TrackedPose, NothingIsSaidWhereNothingWasSeen) {
  const SimulatedFrames frames(3);
  System system(frames.with_mode(true));
  const cv::Mat wall(frames.frames[0].colour_bgr.size(), CV_8UC3, cv::Scalar(80, 80, 80));
  EXPECT_FALSE(system.track(wall, frames.frames[0].depth, 0.5).covariance) << "not started";
  (void)frames.track(system, 0);
  (void)frames.track(system, 1);
  const TrackResult blind = system.track(wall, frames.frames[2].depth, frames.frames[2].time_s);
  EXPECT_EQ(blind.state, TrackingState::kPredicted);
  EXPECT_FALSE(blind.covariance);
}

}  // namespace
}  // namespace cpslam
