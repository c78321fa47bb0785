#include "optim/bundle_adjuster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "cpslam/error.h"
#include "optim/scenes.h"

namespace cpslam {
namespace {

double distance(const SE3& a, const SE3& b) {
  return (a * b.inverse()).log().norm();
}

double worst_pose(const BundleProblem& a, const BundleProblem& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.cam_from_world.size(); ++i) {
    worst = std::max(worst, distance(a.cam_from_world[i], b.cam_from_world[i]));
  }
  return worst;
}

double worst_point(const BundleProblem& a, const BundleProblem& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.point_in_world.size(); ++i) {
    worst = std::max(worst, (a.point_in_world[i] - b.point_in_world[i]).norm());
  }
  return worst;
}

bool same_pose(const SE3& a, const SE3& b) {
  return a.rotation == b.rotation && a.translation == b.translation;
}

bool same_bits(const BundleProblem& a, const BundleProblem& b) {
  return std::equal(a.cam_from_world.begin(), a.cam_from_world.end(), b.cam_from_world.begin(), same_pose) &&
         a.point_in_world == b.point_in_world;
}

BundleOptions tight() {
  BundleOptions options;
  options.robust_iterations = 20;
  options.final_iterations = 30;
  options.function_tolerance = 1e-12;
  return options;
}

TEST(BundleAdjuster, RecoversTheExactSceneFromExactObservations) {
  Random random(51);
  scenes::BundleSceneOptions options;
  options.noise_scale = 0.0;
  scenes::BundleScene scene = scenes::bundle_scene(options, random);
  const BundleResult result = adjust_bundle(scene.start, tight());
  EXPECT_GT(result.initial_cost, 1e4);
  EXPECT_LT(result.final_cost, 1e-8);
  EXPECT_LT(worst_pose(scene.start, scene.truth), 1e-6);
  EXPECT_LT(worst_point(scene.start, scene.truth), 1e-4);
  EXPECT_EQ(std::count(result.outlier.begin(), result.outlier.end(), 1), 0);
  EXPECT_FALSE(result.aborted);
}

TEST(BundleAdjuster, ReachesTheNoiseFloor) {
  Random random(52);
  scenes::BundleScene scene = scenes::bundle_scene({}, random);
  const BundleResult result = adjust_bundle(scene.start, {});
  BundleProblem truth = scene.truth;
  const double cost_of_truth = adjust_bundle(truth, {}).initial_cost;
  EXPECT_GT(result.initial_cost, 10.0 * cost_of_truth);
  EXPECT_LT(result.final_cost, cost_of_truth)
      << "a fit follows the noise a little, so it lies below the truth";
  EXPECT_GT(result.final_cost, 0.4 * cost_of_truth);
  EXPECT_LT(worst_pose(scene.start, scene.truth), 0.01);
  const auto outliers = std::count(result.outlier.begin(), result.outlier.end(), 1);
  EXPECT_LT(static_cast<double>(outliers), 0.05 * static_cast<double>(scene.start.observations.size()));
  EXPECT_GE(result.iterations, 3);
  EXPECT_LE(result.iterations, 15);
}

TEST(BundleAdjuster, DefaultToleranceLosesNothingThatMatters) {
  Random random(53);
  const scenes::BundleScene scene = scenes::bundle_scene({}, random);
  BundleProblem quick = scene.start;
  BundleProblem exact = scene.start;
  const BundleResult quick_result = adjust_bundle(quick, {});
  const BundleResult exact_result = adjust_bundle(exact, tight());
  EXPECT_LT(quick_result.iterations, exact_result.iterations);
  EXPECT_LT(worst_pose(quick, exact), 0.1 * worst_pose(exact, scene.truth));
}

TEST(BundleAdjuster, FixedPosesAndUnseenPointsKeepTheirBits) {
  Random random(54);
  scenes::BundleScene scene = scenes::bundle_scene({}, random);
  scene.start.point_in_world.emplace_back(1.0 / 3.0, 2.0, 3.0);  // no observation at all
  scene.start.cam_from_world.push_back(SE3::exp(scenes::random_twist(1.0, 1.0, random)));  // sees nothing
  scene.start.pose_fixed.push_back(0);
  const BundleProblem before = scene.start;
  adjust_bundle(scene.start, {});
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, before.cam_from_world.size() - 1}) {
    EXPECT_TRUE(same_pose(scene.start.cam_from_world[i], before.cam_from_world[i])) << i;
  }
  EXPECT_EQ(scene.start.point_in_world.back(), before.point_in_world.back());
  EXPECT_FALSE(same_pose(scene.start.cam_from_world[2], before.cam_from_world[2]));
}

TEST(BundleAdjuster, OneFixedPoseHoldsTheGauge) {
  // A rigid motion of the whole start must come out as the same motion of the result.
  Random random(55);
  scenes::BundleSceneOptions options;
  options.fixed = 1;
  scenes::BundleScene scene = scenes::bundle_scene(options, random);
  BundleProblem moved = scene.start;
  const SE3 new_from_old = SE3::exp(scenes::random_twist(2.0, 1.0, random));
  for (SE3& pose : moved.cam_from_world) pose = pose * new_from_old.inverse();
  for (Eigen::Vector3d& point : moved.point_in_world) point = new_from_old * point;
  adjust_bundle(scene.start, tight());
  adjust_bundle(moved, tight());
  for (SE3& pose : moved.cam_from_world) pose = pose * new_from_old;
  EXPECT_LT(worst_pose(moved, scene.start), 1e-5);
  EXPECT_LT(worst_pose(scene.start, scene.truth), 0.02);
}

TEST(BundleAdjuster, FindsTheWrongObservations) {
  Random random(56);
  scenes::BundleSceneOptions options;
  options.noise_scale = 0.2;
  scenes::BundleScene scene = scenes::bundle_scene(options, random);
  std::vector<std::uint8_t> expected(scene.start.observations.size(), 0);
  for (std::size_t i = 0; i < expected.size(); i += 23) {
    PointObservation& seen = scene.start.observations[i].seen;
    seen.uv += Eigen::Vector2d(random.uniform(40.0, 90.0), random.uniform(-90.0, -40.0));
    if (seen.has_depth()) seen.disparity += 40.0;
    expected[i] = 1;
  }
  const BundleResult result = adjust_bundle(scene.start, {});
  EXPECT_EQ(result.outlier, expected);
  EXPECT_LT(worst_pose(scene.start, scene.truth), 0.005);
}

TEST(BundleAdjuster, ObservationsBehindTheCameraOrBrokenAreOutliersAndDoNoHarm) {
  Random random(57);
  scenes::BundleSceneOptions options;
  options.noise_scale = 0.0;
  scenes::BundleScene scene = scenes::bundle_scene(options, random);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n_points = scene.start.point_in_world.size();
  scene.start.point_in_world.emplace_back(nan, 0.0, 1.0);
  scene.start.point_in_world.emplace_back(0.0, 0.0, -3.0);  // behind every camera
  const auto n = scene.start.observations.size();
  PointObservation seen;
  seen.uv = {300.0, 200.0};
  scene.start.observations.push_back({3, static_cast<int>(n_points), seen});
  scene.start.observations.push_back({3, static_cast<int>(n_points) + 1, seen});
  seen.uv.x() = nan;
  scene.start.observations.push_back({3, 0, seen});
  const BundleResult result = adjust_bundle(scene.start, tight());
  EXPECT_EQ(std::count(result.outlier.begin(), result.outlier.end(), 1), 3);
  for (std::size_t i = n; i < n + 3; ++i) EXPECT_EQ(result.outlier[i], 1);
  EXPECT_LT(worst_pose(scene.start, scene.truth), 1e-6);
  EXPECT_TRUE(std::isfinite(result.final_cost));
}

TEST(BundleAdjuster, AllPosesFixedRefinesThePoints) {
  Random random(58);
  scenes::BundleSceneOptions options;
  options.fixed = options.poses;
  options.noise_scale = 0.0;
  scenes::BundleScene scene = scenes::bundle_scene(options, random);
  adjust_bundle(scene.start, tight());
  EXPECT_LT(worst_point(scene.start, scene.truth), 1e-4);
}

TEST(BundleAdjuster, ManyPosesGoThroughTheSparseSolver) {
  Random random(59);
  scenes::BundleSceneOptions options;
  options.poses = 70;
  options.points = 2000;
  options.noise_scale = 0.0;
  scenes::BundleScene scene = scenes::bundle_scene(options, random);
  adjust_bundle(scene.start, tight());
  EXPECT_LT(worst_pose(scene.start, scene.truth), 1e-5);
}

TEST(BundleAdjuster, AFlagThatIsUpBeforehandChangesNothing) {
  Random random(60);
  scenes::BundleScene scene = scenes::bundle_scene({}, random);
  const BundleProblem before = scene.start;
  const std::atomic<bool> abort{true};
  BundleOptions options;
  options.abort = &abort;
  const BundleResult result = adjust_bundle(scene.start, options);
  EXPECT_TRUE(result.aborted);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(result.final_cost, result.initial_cost);
  EXPECT_TRUE(same_bits(scene.start, before));
  EXPECT_EQ(result.outlier.size(), scene.start.observations.size());
}

TEST(BundleAdjuster, AnAbortFromAnotherThreadKeepsTheProgress) {
  Random random(61);
  scenes::BundleSceneOptions scene_options;
  scene_options.poses = 20;
  scene_options.points = 2000;
  const scenes::BundleScene scene = scenes::bundle_scene(scene_options, random);
  BundleOptions options = tight();
  BundleProblem whole = scene.start;
  const auto start = std::chrono::steady_clock::now();
  const int all_iterations = adjust_bundle(whole, options).iterations;
  const auto duration = std::chrono::steady_clock::now() - start;

  // However the machine is loaded, one of the moments falls into the solve.
  int n_midway = 0;
  for (int tenth = 1; tenth <= 10 && n_midway < 2; ++tenth) {
    BundleProblem problem = scene.start;
    std::atomic<bool> abort{false};
    options.abort = &abort;
    std::thread raiser([&abort, duration, tenth] {
      std::this_thread::sleep_for(duration * tenth / 10);
      abort = true;
    });
    const BundleResult result = adjust_bundle(problem, options);
    const bool raised_in_time = abort;
    raiser.join();
    EXPECT_LE(result.aborted, raised_in_time);
    EXPECT_LE(result.final_cost, result.initial_cost);
    if (!result.aborted || result.iterations == 0 || result.iterations == all_iterations) continue;
    ++n_midway;
    EXPECT_LT(result.iterations, all_iterations);
    EXPECT_LT(result.final_cost, result.initial_cost);
    EXPECT_FALSE(same_bits(problem, scene.start));
  }
  EXPECT_GT(n_midway, 0);
}

TEST(BundleAdjuster, TwoRunsGiveTheSameBits) {
  Random random(62);
  const scenes::BundleScene scene = scenes::bundle_scene({}, random);
  BundleProblem first = scene.start;
  BundleProblem second = scene.start;
  const BundleResult first_result = adjust_bundle(first, {});
  const BundleResult second_result = adjust_bundle(second, {});
  EXPECT_TRUE(same_bits(first, second));
  EXPECT_EQ(first_result.final_cost, second_result.final_cost);
  EXPECT_EQ(first_result.outlier, second_result.outlier);
}

TEST(BundleAdjuster, BadProblemsAreNamed) {
  Random random(63);
  const BundleProblem good = scenes::bundle_scene({}, random).start;
  const auto expect_error = [](BundleProblem problem, const std::string& part) {
    try {
      adjust_bundle(problem, {});
      ADD_FAILURE() << "no error that says " << part;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  BundleProblem bad = good;
  bad.observations[5].pose = 8;
  expect_error(bad, "pose 8 of 8");
  bad.observations[5].pose = -1;
  expect_error(bad, "pose -1");
  bad = good;
  bad.observations[7].point = 300;
  expect_error(bad, "point 300 of 300");
  bad = good;
  std::fill(bad.pose_fixed.begin(), bad.pose_fixed.end(), std::uint8_t{0});
  expect_error(bad, "fixed");
  bad = good;
  bad.pose_fixed.pop_back();
  expect_error(bad, "pose_fixed");
}

TEST(BundleAdjuster, NothingToDoIsNoError) {
  BundleProblem empty;
  const BundleResult result = adjust_bundle(empty, {});
  EXPECT_FALSE(result.aborted);
  EXPECT_TRUE(result.outlier.empty());
  EXPECT_EQ(result.iterations, 0);

  BundleProblem poses_only;
  poses_only.cam_from_world.resize(2);
  poses_only.pose_fixed = {1, 0};
  EXPECT_EQ(adjust_bundle(poses_only, {}).final_cost, 0.0);
}

TEST(BundleAdjuster, SaysNothingOnTheConsole) {
  Random random(64);
  scenes::BundleScene scene = scenes::bundle_scene({}, random);
  scene.start.observations[0].seen.uv.x() = std::numeric_limits<double>::quiet_NaN();
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  adjust_bundle(scene.start, {});
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace cpslam
