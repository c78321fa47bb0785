#include "optim/pose_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "cpslam/error.h"
#include "optim/scenes.h"

namespace cpslam {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

Matrix6d information(double sigma_m, double sigma_rad) {
  Vector6d diagonal = Vector6d::Constant(1.0 / (sigma_m * sigma_m));
  diagonal.tail<3>().setConstant(1.0 / (sigma_rad * sigma_rad));
  return diagonal.asDiagonal();
}

/// Round a square of 4 x 10 steps of 0.25 m, a quarter turn at each corner: the camera's true poses.
std::vector<SE3> square() {
  std::vector<SE3> cam_from_world{SE3()};
  for (int i = 1; i < 40; ++i) {
    Vector6d step = Vector6d::Zero();
    step.z() = -0.25;
    if (i % 10 == 0) step[4] = 0.5 * std::numbers::pi;
    cam_from_world.push_back(SE3::exp(step) * cam_from_world.back());
  }
  return cam_from_world;
}

/// The square as odometry with the given drift per step sees it; the last edge closes the loop, exactly.
PoseGraph drifted_square(double drift_m, double drift_rad, Random& random) {
  const std::vector<SE3> truth = square();
  PoseGraph graph;
  graph.cam_from_world.push_back(truth.front());
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const SE3 step =
        SE3::exp(scenes::random_twist(drift_m, drift_rad, random)) * truth[i] * truth[i - 1].inverse();
    graph.cam_from_world.push_back(step * graph.cam_from_world.back());
    graph.edges.push_back(
        {static_cast<int>(i) - 1, static_cast<int>(i), step, information(drift_m, drift_rad)});
  }
  const int last = static_cast<int>(truth.size()) - 1;
  graph.edges.push_back({last, 0, truth.front() * truth.back().inverse(), information(1e-3, 1e-3)});
  graph.pose_fixed.assign(truth.size(), 0);
  graph.pose_fixed[0] = 1;
  return graph;
}

/// Root mean square of the camera centres' distances.
double error_m(const std::vector<SE3>& found, const std::vector<SE3>& truth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    sum += (found[i].inverse().translation - truth[i].inverse().translation).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(found.size()));
}

void expect_same(const SE3& a, const SE3& b) {
  EXPECT_EQ(a.rotation, b.rotation);
  EXPECT_EQ(a.translation, b.translation);
}

TEST(PoseGraph, SquareLoopWithDriftRecovers) {
  const std::vector<SE3> truth = square();
  double before = 0.0;
  double after = 0.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    PoseGraph graph = drifted_square(0.01, 0.01, random);
    const double start = error_m(graph.cam_from_world, truth);
    const PoseGraphResult result = optimize_pose_graph(graph, {});
    EXPECT_FALSE(result.aborted);
    EXPECT_LT(result.final_cost, 0.01 * result.initial_cost);
    const SE3 closing = graph.cam_from_world.front() * graph.cam_from_world.back().inverse() *
                        (truth.front() * truth.back().inverse()).inverse();
    EXPECT_LT(closing.log().norm(), 2e-3) << "the loop is closed";
    before += start;
    after += error_m(graph.cam_from_world, truth);
  }
  EXPECT_LT(after, 0.6 * before) << "random walks become bridges";
}

TEST(PoseGraph, AConstantDriftIsTakenOutOfEveryEdge) {
  // Every step of a circle turns a thousandth too far: all edges are off by the same, and the loop says so.
  constexpr int kSteps = 60;
  Vector6d step = Vector6d::Zero();
  step.z() = -0.1;
  step[4] = 2.0 * std::numbers::pi / kSteps;
  Vector6d too_far = step;
  too_far[4] += 1e-3;
  std::vector<SE3> truth{SE3()};
  PoseGraph graph;
  graph.cam_from_world.emplace_back();
  for (int i = 1; i < kSteps; ++i) {
    truth.push_back(SE3::exp(step) * truth.back());
    graph.cam_from_world.push_back(SE3::exp(too_far) * graph.cam_from_world.back());
    graph.edges.push_back({i - 1, i, SE3::exp(too_far), information(0.01, 0.01)});
  }
  graph.edges.push_back({kSteps - 1, 0, SE3::exp(step), information(1e-5, 1e-5)});
  graph.pose_fixed.assign(truth.size(), 0);
  graph.pose_fixed[0] = 1;
  EXPECT_GT(error_m(graph.cam_from_world, truth), 0.03);
  optimize_pose_graph(graph, {});
  EXPECT_LT(error_m(graph.cam_from_world, truth), 0.004);
}

TEST(PoseGraph, ExactAnswerStaysBitByBit) {
  Random random(2);
  PoseGraph graph = drifted_square(0.01, 0.01, random);
  graph.edges.pop_back();  // without the loop every edge says what the poses say
  const std::vector<SE3> before = graph.cam_from_world;
  const PoseGraphResult result = optimize_pose_graph(graph, {});
  EXPECT_LT(result.initial_cost, 1e-20);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_TRUE(graph.cam_from_world[i].rotation.isApprox(before[i].rotation, 1e-12));
    EXPECT_LT((graph.cam_from_world[i].translation - before[i].translation).norm(), 1e-12);
  }
}

TEST(PoseGraph, FixedPosesKeepTheirBits) {
  Random random(3);
  PoseGraph graph = drifted_square(0.02, 0.02, random);
  graph.pose_fixed[17] = 1;
  const std::vector<SE3> before = graph.cam_from_world;
  optimize_pose_graph(graph, {});
  expect_same(graph.cam_from_world[0], before[0]);
  expect_same(graph.cam_from_world[17], before[17]);
  EXPECT_NE(graph.cam_from_world[18].translation, before[18].translation);
}

TEST(PoseGraph, WithoutAFixedPoseTheFirstOfEachPartHoldsTheGauge) {
  Random random(4);
  PoseGraph graph = drifted_square(0.02, 0.02, random);
  const int n = static_cast<int>(graph.cam_from_world.size());
  const PoseGraph other = drifted_square(0.02, 0.02, random);
  graph.cam_from_world.insert(graph.cam_from_world.end(), other.cam_from_world.begin(),
                              other.cam_from_world.end());
  for (PoseGraph::Edge edge : other.edges) {
    edge.a += n;
    edge.b += n;
    graph.edges.push_back(edge);
  }
  graph.cam_from_world.push_back(SE3::exp(scenes::random_twist(1.0, 1.0, random)));  // knows nobody
  graph.pose_fixed.assign(graph.cam_from_world.size(), 0);
  const std::vector<SE3> before = graph.cam_from_world;
  const PoseGraphResult result = optimize_pose_graph(graph, {});
  EXPECT_LT(result.final_cost, 0.01 * result.initial_cost);
  expect_same(graph.cam_from_world[0], before[0]);
  expect_same(graph.cam_from_world[static_cast<std::size_t>(n)], before[static_cast<std::size_t>(n)]);
  expect_same(graph.cam_from_world.back(), before.back());
  PoseGraph alone = other;
  alone.pose_fixed.assign(alone.cam_from_world.size(), 0);
  optimize_pose_graph(alone, {});
  for (std::size_t i = 0; i < alone.cam_from_world.size(); ++i) {
    const SE3& together = graph.cam_from_world[i + static_cast<std::size_t>(n)];
    EXPECT_LT((together.translation - alone.cam_from_world[i].translation).norm(), 1e-4);
  }
}

TEST(PoseGraph, TheSurerEdgeWins) {
  PoseGraph graph;
  graph.cam_from_world.assign(2, SE3());
  graph.pose_fixed = {1, 0};
  const SE3 one(Eigen::Matrix3d::Identity(), {1.0, 0.0, 0.0});
  const SE3 two(Eigen::Matrix3d::Identity(), {2.0, 0.0, 0.0});
  graph.edges = {{0, 1, one, 3.0 * Matrix6d::Identity()}, {0, 1, two, Matrix6d::Identity()}};
  optimize_pose_graph(graph, {});
  EXPECT_NEAR(graph.cam_from_world[1].translation.x(), 1.25, 1e-3);
}

TEST(PoseGraph, RobustKernelLimitsAFalseLoop) {
  Random random(5);
  const PoseGraph good = drifted_square(0.01, 0.005, random);
  PoseGraph robust = good;
  // Opposite corners are said to be one place, as often as there are true loops.
  robust.edges.push_back({5, 25, SE3(), information(0.01, 0.01)});
  PoseGraph plain = robust;
  PoseGraphOptions options;
  optimize_pose_graph(plain, options);
  options.robust = true;
  optimize_pose_graph(robust, options);
  EXPECT_LT(error_m(robust.cam_from_world, square()), 0.5 * error_m(plain.cam_from_world, square()));
}

TEST(PoseGraph, RaisedFlagEndsItAtOnce) {
  Random random(6);
  PoseGraph graph = drifted_square(0.02, 0.02, random);
  const std::vector<SE3> before = graph.cam_from_world;
  const std::atomic<bool> abort = true;
  PoseGraphOptions options;
  options.abort = &abort;
  const PoseGraphResult result = optimize_pose_graph(graph, options);
  EXPECT_TRUE(result.aborted);
  EXPECT_EQ(result.iterations, 0);
  for (std::size_t i = 0; i < before.size(); ++i) expect_same(graph.cam_from_world[i], before[i]);
}

TEST(PoseGraph, IsReproducibleToTheBit) {
  Random random(7);
  const PoseGraph start = drifted_square(0.02, 0.02, random);
  PoseGraph first = start;
  PoseGraph second = start;
  optimize_pose_graph(first, {});
  optimize_pose_graph(second, {});
  for (std::size_t i = 0; i < start.cam_from_world.size(); ++i) {
    expect_same(first.cam_from_world[i], second.cam_from_world[i]);
  }
}

TEST(PoseGraph, RefusesWhatCannotBeSolved) {
  Random random(8);
  const PoseGraph good = drifted_square(0.01, 0.01, random);
  const auto expect_refused = [&](auto&& spoil) {
    PoseGraph graph = good;
    spoil(graph);
    EXPECT_THROW(optimize_pose_graph(graph, {}), InputError);
  };
  expect_refused([](PoseGraph& g) { g.pose_fixed.pop_back(); });
  expect_refused([](PoseGraph& g) { g.edges[3].b = 40; });
  expect_refused([](PoseGraph& g) { g.edges[3].a = -1; });
  expect_refused([](PoseGraph& g) { g.edges[3].a = g.edges[3].b; });
  expect_refused([](PoseGraph& g) { g.edges[3].b_from_a.translation.x() = std::nan(""); });
  expect_refused(
      [](PoseGraph& g) { g.edges[3].information(2, 2) = std::numeric_limits<double>::infinity(); });
  expect_refused([](PoseGraph& g) { g.edges[3].information = -Matrix6d::Identity(); });
  expect_refused([](PoseGraph& g) { g.cam_from_world[9].rotation(0, 0) = std::nan(""); });
}

TEST(PoseGraph, NothingToDoIsNoError) {
  PoseGraph graph;
  EXPECT_EQ(optimize_pose_graph(graph, {}).iterations, 0);
  graph.cam_from_world.resize(3);
  graph.pose_fixed.resize(3);
  EXPECT_EQ(optimize_pose_graph(graph, {}).iterations, 0);
}

}  // namespace
}  // namespace cpslam
