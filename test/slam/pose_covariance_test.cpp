// What track() says about how sure a pose is.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
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
  constexpr int kWalks = 24;
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
  RecordProperty("ratio", ::testing::PrintToString(std::vector<double>(ratio.begin(), ratio.end())));
  std::printf("%f %f %f %f %f %f\n", ratio[0], ratio[1], ratio[2], ratio[3], ratio[4], ratio[5]);
  EXPECT_GT(ratio.minCoeff(), 0.3);
  EXPECT_LT(ratio.maxCoeff(), 3.0);
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

TEST(TrackedPose, IsWeakOnFewPointsAndSaysLessThere) {
  const SimulatedFrames frames(40);
  System system(frames.with_mode(true));
  for (std::size_t i = 0; i < 30; ++i) ASSERT_EQ(frames.track(system, i).state, TrackingState::kTracked) << i;
  const TrackResult seen = frames.track(system, 30);
  ASSERT_TRUE(seen.covariance);
  // Somebody's back: ever less of the picture is left.
  bool was_weak = false;
  for (std::size_t i = 31; i < 40 && !was_weak; ++i) {
    cv::Mat colour = frames.frames[i].colour_bgr.clone(), depth = frames.frames[i].depth.clone();
    const int covered = colour.cols * static_cast<int>(i - 25) / 15;
    colour.colRange(0, covered).setTo(cv::Scalar(40, 40, 40));
    depth.colRange(0, covered).setTo(cv::Scalar(0));
    const TrackResult result = system.track(colour, depth, frames.frames[i].time_s);
    was_weak = result.state == TrackingState::kWeak;
    if (!was_weak) continue;
    EXPECT_TRUE(is_tracked(result.state));
    ASSERT_TRUE(result.covariance);
    EXPECT_GT(to_matrix(*result.covariance).trace(), to_matrix(*seen.covariance).trace());
  }
  EXPECT_TRUE(was_weak);
  EXPECT_EQ(system.statistics().weak, 1U);
  EXPECT_EQ(system.statistics().tracked, system.trajectory().size()) << "weak poses are in the trajectory";
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
