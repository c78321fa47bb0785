#include "optim/pose_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <deque>
#include <limits>
#include <numbers>

#include "ceres/problem.h"
#include "ceres/solver.h"
#include "optim/pose_equations.h"
#include "optim/reprojection.h"
#include "optim/reprojection_cost.h"
#include "optim/scenes.h"

namespace cpslam {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
constexpr double kTenDegrees = 10.0 * std::numbers::pi / 180.0;

SE3 random_pose(Random& random) {
  return SE3::exp(scenes::random_twist(1.5, random.uniform(0.0, 3.0), random));
}

SE3 disturbed(const SE3& pose, double translation_m, double rotation_rad, Random& random) {
  return SE3::exp(scenes::random_twist(translation_m, rotation_rad, random)) * pose;
}

double distance(const SE3& a, const SE3& b) {
  return (a * b.inverse()).log().norm();
}

bool finite(const PoseSolverResult& result) {
  return result.cam_from_world.rotation.allFinite() && result.cam_from_world.translation.allFinite() &&
         result.covariance.allFinite() && std::isfinite(result.chi2);
}

/// Ceres's answer over the inliers that the solver chose.
SE3 reference_pose(const SE3& start, const std::vector<PoseObservation>& observations,
                   const std::vector<std::uint8_t>& outlier) {
  const ReprojectionCamera camera = scenes::camera();
  std::array<double, 7> block{};
  write_pose_block(start, block.data());
  std::vector<Eigen::Vector3d> points;
  for (const PoseObservation& observation : observations) points.push_back(observation.point_in_world);
  ceres::Problem problem;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (outlier[i] != 0) continue;
    ceres::CostFunction* cost = nullptr;
    if (observations[i].seen.has_depth()) {
      cost = new DepthCost(camera, observations[i].seen);
    } else {
      cost = new MonoCost(camera, observations[i].seen);
    }
    problem.AddResidualBlock(cost, nullptr, block.data(), points[i].data());
    problem.SetParameterBlockConstant(points[i].data());
  }
  problem.SetManifold(block.data(), new PoseManifold);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  options.max_num_iterations = 100;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  EXPECT_TRUE(summary.IsSolutionUsable());
  return read_pose_block(block.data());
}

TEST(PoseEquations, AreTheSumsOfTheJacobiansWrittenOutPlainly) {
  Random random(31);
  const SE3 pose = random_pose(random);
  auto observations = scenes::frame(pose, 21, 0.5, 3.0, random);
  observations[3].point_in_world =
      pose.inverse() * Eigen::Vector3d(0.1, 0.2, 0.005);  // at the camera's plane
  for (const bool robust : {false, true}) {
    PoseEquations equations(scenes::camera(), observations);
    equations.select(pose, PoseEquations::Gate::kNone);
    const PoseModel model = equations.linearize(pose, robust);
    Matrix6d information = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    double cost = 0.0;
    for (const auto& [point, seen] : observations) {
      const Eigen::Vector3d p = pose * point;
      if (p.z() <= kMinDepthM) continue;
      Eigen::Matrix<double, 3, 6> by_twist;
      by_twist << Eigen::Matrix3d::Identity(), -skew(p);
      by_twist = (reprojection_jacobian(scenes::camera(), p, seen) * by_twist).eval();
      const Eigen::Vector3d error = reprojection_error(scenes::camera(), p, seen);
      const double chi2 = error.squaredNorm();
      const double weight = robust ? std::min(1.0, std::sqrt(chi2_gate(seen) / chi2)) : 1.0;
      information += weight * by_twist.transpose() * by_twist;
      gradient += weight * by_twist.transpose() * error;
      cost += robust ? huber(chi2, chi2_gate(seen)) : chi2;
    }
    EXPECT_TRUE(model.information.isApprox(information, 1e-12));
    EXPECT_TRUE(model.gradient.isApprox(gradient, 1e-12));
    EXPECT_NEAR(model.cost, cost, 1e-12 * cost);
  }
}

TEST(PoseSolver, RecoversTheExactPoseFromTwentyCentimetresAndTenDegrees) {
  Random random(32);
  for (int trial = 0; trial < 50; ++trial) {
    const SE3 truth = random_pose(random);
    const double depth_ratio = trial % 3 == 0 ? 0.0 : 0.7;  // every third is monocular
    const auto observations = scenes::frame(truth, 200, depth_ratio, 0.0, random);
    const PoseSolverResult result =
        solve_pose(scenes::camera(), disturbed(truth, 0.2, kTenDegrees, random), observations);
    EXPECT_LT(distance(result.cam_from_world, truth), 1e-8);
    EXPECT_EQ(result.n_inliers, 200);
    EXPECT_LT(result.chi2, 1e-9);
  }
}

TEST(PoseSolver, FlagsExactlyTheGrossOutliers) {
  Random random(33);
  for (int trial = 0; trial < 20; ++trial) {
    const SE3 truth = random_pose(random);
    auto observations = scenes::frame(truth, 300, 0.7, 0.2, random);
    std::vector<std::uint8_t> expected(observations.size(), 0);
    for (std::size_t i = 0; i < observations.size(); ++i) {
      if (i % 5 > 1) continue;  // 40 %
      const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
      PointObservation& seen = observations[i].seen;
      const Eigen::Vector2d shift =
          random.uniform(30.0, 200.0) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      seen.uv += shift;
      expected[i] = 1;
    }
    const SE3 start = disturbed(truth, 0.2, kTenDegrees, random);
    const PoseSolverResult result = solve_pose(scenes::camera(), start, observations);
    EXPECT_EQ(result.outlier, expected) << "trial " << trial;
    EXPECT_EQ(result.n_inliers, 180);
    EXPECT_LT(distance(result.cam_from_world, truth), 0.005);
  }
}

TEST(PoseSolver, FindsTheWayWithFewPointsAndMatchesAllOverTheImage) {
  Random random(43);
  int n_found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const SE3 truth = random_pose(random);
    auto observations = scenes::frame(truth, 50, 0.0, 1.0, random);
    for (std::size_t i = 0; i < 20; ++i) {
      observations[i].seen.uv = {random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)};
    }
    const SE3 start = disturbed(truth, 0.2, kTenDegrees, random);
    const SE3 found = solve_pose(scenes::camera(), start, observations).cam_from_world;
    n_found += distance(found, solve_pose(scenes::camera(), truth, observations).cam_from_world) < 1e-3;
  }
  EXPECT_GE(n_found, 195);  // 191 when the gate of the robust rounds does not follow the median
}

TEST(PoseSolver, AgreesWithCeresOnItsInliers) {
  Random random(34);
  for (int trial = 0; trial < 20; ++trial) {
    const SE3 truth = random_pose(random);
    const auto observations = scenes::frame(truth, 150, trial % 2 == 0 ? 0.8 : 0.0, 1.0, random);
    const SE3 start = disturbed(truth, 0.05, 0.05, random);
    const PoseSolverResult result = solve_pose(scenes::camera(), start, observations);
    EXPECT_GT(result.n_inliers, 130);
    EXPECT_LT(result.n_inliers, 150);  // the gate cuts 5 % of normal noise
    EXPECT_LT(distance(result.cam_from_world, reference_pose(start, observations, result.outlier)), 1e-5);
  }
}

TEST(PoseSolver, CovarianceIsThatOfAMonteCarlo) {
  Random random(35);
  const SE3 truth = random_pose(random);
  const auto exact = scenes::frame(truth, 120, 0.7, 0.0, random);
  const int n_trials = 400;
  Matrix6d sampled = Matrix6d::Zero();
  Matrix6d claimed = Matrix6d::Zero();
  for (int trial = 0; trial < n_trials; ++trial) {
    auto observations = exact;
    for (PoseObservation& observation : observations) {
      PointObservation& seen = observation.seen;
      const double u_noise = seen.sigma_px * random.normal();
      seen.uv += Eigen::Vector2d(u_noise, seen.sigma_px * random.normal());
      if (seen.has_depth()) seen.disparity += seen.sigma_disparity_px * random.normal();
    }
    const PoseSolverResult result = solve_pose(scenes::camera(), truth, observations);
    const Vector6d error = (result.cam_from_world * truth.inverse()).log();
    sampled += error * error.transpose() / n_trials;
    claimed += result.covariance / n_trials;
  }
  // In every direction of the six-dimensional space, not only along the axes.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d> ratio(sampled, claimed);
  EXPECT_GT(std::sqrt(ratio.eigenvalues().minCoeff()), 0.7);
  EXPECT_LT(std::sqrt(ratio.eigenvalues().maxCoeff()), 1.3);
}

TEST(PoseSolver, FewerPointsLeaveThePoseVaguerInEveryDirection) {
  Random random(44);
  for (int trial = 0; trial < 30; ++trial) {
    const SE3 truth = random_pose(random);
    const auto all = scenes::frame(truth, 200, 0.7, 0.0, random);
    Matrix6d with_more = solve_pose(scenes::camera(), truth, all).covariance;
    for (const std::ptrdiff_t n : {100, 50, 20, 8}) {
      const std::vector<PoseObservation> some(all.begin(), all.begin() + n);
      const Matrix6d with_fewer = solve_pose(scenes::camera(), truth, some).covariance;
      const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d> ratio(with_fewer, with_more);
      EXPECT_GT(ratio.eigenvalues().minCoeff(), 1.0) << n;
      with_more = with_fewer;
    }
  }
}

TEST(PoseSolver, TooFewObservationsGiveTheStartBack) {
  Random random(36);
  const SE3 truth = random_pose(random);
  const SE3 start = disturbed(truth, 0.1, 0.1, random);
  for (const std::size_t n : {0U, 1U, 2U}) {
    const auto observations = scenes::frame(truth, n, 1.0, 0.0, random);
    const PoseSolverResult result = solve_pose(scenes::camera(), start, observations);
    EXPECT_EQ(distance(result.cam_from_world, start), distance(start, start));
    EXPECT_EQ(result.outlier, std::vector<std::uint8_t>(n, 1));
    EXPECT_EQ(result.n_inliers, 0);
    EXPECT_DOUBLE_EQ(result.covariance(0, 0), kUnknownPoseVariance);
  }
}

TEST(PoseSolver, PointsBehindTheCameraAreOutliersAndMoveNothing) {
  Random random(37);
  const SE3 truth = random_pose(random);
  auto observations = scenes::frame(truth, 60, 0.5, 0.0, random);
  const auto behind = [&](PoseObservation& observation) {
    observation.point_in_world = truth.inverse() * Eigen::Vector3d(-(truth * observation.point_in_world));
  };
  for (std::size_t i = 0; i < 20; ++i) behind(observations[i]);
  PoseSolverResult result = solve_pose(scenes::camera(), truth, observations);
  EXPECT_LT(distance(result.cam_from_world, truth), 1e-8);
  EXPECT_EQ(result.n_inliers, 40);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(result.outlier[i] != 0, i < 20);

  for (std::size_t i = 20; i < 60; ++i) behind(observations[i]);
  result = solve_pose(scenes::camera(), truth, observations);
  EXPECT_EQ(result.cam_from_world.rotation, truth.rotation);
  EXPECT_EQ(result.cam_from_world.translation, truth.translation);
  EXPECT_EQ(result.n_inliers, 0);
}

TEST(PoseSolver, PointsThatComeIntoViewLaterTakePartAgain) {
  // From a start half a metre too far ahead the near points are behind the camera.
  Random random(38);
  const SE3 truth = random_pose(random);
  auto observations = scenes::frame(truth, 200, 0.7, 0.0, random);
  for (std::size_t i = 0; i < 30; ++i) {
    const Eigen::Vector3d near_point(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.45);
    observations[i].point_in_world = truth.inverse() * near_point;
    observations[i].seen = scenes::observe(near_point, true, 0.0, random);
  }
  const SE3 start = SE3(Eigen::Matrix3d::Identity(), {0.0, 0.0, -0.5}) * truth;
  const PoseSolverResult result = solve_pose(scenes::camera(), start, observations);
  EXPECT_EQ(result.n_inliers, 200);
  EXPECT_LT(distance(result.cam_from_world, truth), 1e-8);
}

TEST(PoseSolver, SingularScenesStayFiniteAndSayHowLittleTheyKnow) {
  Random random(39);
  const SE3 truth = random_pose(random);
  const SE3 start = disturbed(truth, 0.05, 0.05, random);
  std::vector<std::vector<Eigen::Vector3d>> scenes_in_cam;
  scenes_in_cam.push_back(std::vector<Eigen::Vector3d>(20, {0.3, -0.2, 2.0}));  // one point
  scenes_in_cam.push_back(std::vector<Eigen::Vector3d>(20, {0.0, 0.0, 2.0}));   // on the optical axis
  scenes_in_cam.emplace_back();                                                 // on a line
  scenes_in_cam.emplace_back();  // on a line through the camera
  for (int i = 0; i < 20; ++i) {
    scenes_in_cam[2].emplace_back(-0.5 + 0.05 * i, 0.1, 2.0);
    scenes_in_cam[3].emplace_back(Eigen::Vector3d(0.1, 0.2, 1.0) * (0.5 + 0.1 * i));
  }
  for (const bool depth : {false, true}) {
    for (const auto& points : scenes_in_cam) {
      std::vector<PoseObservation> observations;
      for (const Eigen::Vector3d& p : points) {
        observations.push_back({truth.inverse() * p, scenes::observe(p, depth, 0.0, random)});
      }
      const PoseSolverResult result = solve_pose(scenes::camera(), start, observations);
      ASSERT_TRUE(finite(result));
      EXPECT_EQ(result.n_inliers, 20) << "what is seen can be explained exactly";
      EXPECT_LT(distance(result.cam_from_world, start), 1.0) << "unseen directions must not run away";
      const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(result.covariance);
      EXPECT_GT(eigen.eigenvalues().minCoeff(), 0.0);
      EXPECT_NEAR(eigen.eigenvalues().maxCoeff(), kUnknownPoseVariance, 1e-3 * kUnknownPoseVariance);
    }
  }
}

TEST(PoseSolver, BrokenNumbersAreOutliersAndDoNoHarm) {
  Random random(40);
  const SE3 truth = random_pose(random);
  auto observations = scenes::frame(truth, 60, 0.5, 0.0, random);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  observations[0].point_in_world.x() = nan;
  observations[1].point_in_world.z() = infinity;
  observations[2].seen.uv.y() = nan;
  observations[3].seen.disparity = nan;
  observations[4].seen.disparity = infinity;
  observations[5].seen.sigma_px = 0.0;
  observations[6].seen.sigma_px = nan;
  observations[7].seen.disparity = 100.0;
  observations[7].seen.sigma_disparity_px = 0.0;
  observations[8].seen.uv.x() = 1e300;
  const SE3 start = disturbed(truth, 0.05, 0.05, random);
  const PoseSolverResult result = solve_pose(scenes::camera(), start, observations);
  ASSERT_TRUE(finite(result));
  EXPECT_LT(distance(result.cam_from_world, truth), 1e-8);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(result.outlier[i] != 0, i < 9) << i;
}

TEST(PoseSolver, OnlyRubbishStaysFinite) {
  Random random(41);
  for (int trial = 0; trial < 50; ++trial) {
    const SE3 truth = random_pose(random);
    auto observations = scenes::frame(truth, 3 + random.index(20), 0.5, 0.0, random);
    for (PoseObservation& observation : observations) {
      observation.seen.uv = {random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)};
    }
    const PoseSolverResult result = solve_pose(scenes::camera(), truth, observations);
    EXPECT_TRUE(finite(result));
    EXPECT_EQ(result.n_inliers, std::count(result.outlier.begin(), result.outlier.end(), 0));
  }
}

TEST(PoseSolver, SameInputSameBits) {
  Random random(42);
  const SE3 truth = random_pose(random);
  const auto observations = scenes::frame(truth, 333, 0.6, 1.5, random);
  const SE3 start = disturbed(truth, 0.05, 0.05, random);
  const PoseSolverResult first = solve_pose(scenes::camera(), start, observations);
  const PoseSolverResult second = solve_pose(scenes::camera(), start, observations);
  EXPECT_EQ(first.cam_from_world.rotation, second.cam_from_world.rotation);
  EXPECT_EQ(first.cam_from_world.translation, second.cam_from_world.translation);
  EXPECT_EQ(first.covariance, second.covariance);
  EXPECT_EQ(first.outlier, second.outlier);
}

}  // namespace
}  // namespace cpslam
