#include <benchmark/benchmark.h>

#include <numbers>

#include "optim/bundle_adjuster.h"
#include "optim/pose_graph.h"
#include "optim/pose_solver.h"
#include "optim/scenes.h"
#include "util/random.h"

namespace cpslam {
namespace {

/// A frame as tracking meets it: every tenth match wrong, the prediction 2 cm and 1 degree off.
void solve_pose_of_a_frame(benchmark::State& state) {
  Random random(1);
  const SE3 truth = SE3::exp(scenes::random_twist(1.0, 0.5, random));
  auto observations = scenes::frame(truth, static_cast<std::size_t>(state.range(0)), 0.8, 1.0, random);
  for (std::size_t i = 0; i < observations.size(); i += 10) {
    observations[i].seen.uv.x() += random.uniform(20.0, 60.0);
  }
  const SE3 start = SE3::exp(scenes::random_twist(0.02, 0.0175, random)) * truth;
  for (auto _ : state) benchmark::DoNotOptimize(solve_pose(scenes::camera(), start, observations));
}
BENCHMARK(solve_pose_of_a_frame)->Arg(300)->Arg(1000)->Unit(benchmark::kMicrosecond);

/// keyframes, free keyframes, points, function_tolerance in units of 1e-6 (0: all 5 + 10 iterations are done)
void adjust_local_bundle(benchmark::State& state) {
  Random random(2);
  scenes::BundleSceneOptions options;
  options.poses = static_cast<std::size_t>(state.range(0));
  options.fixed = options.poses - static_cast<std::size_t>(state.range(1));
  options.points = static_cast<std::size_t>(state.range(2));
  const scenes::BundleScene scene = scenes::bundle_scene(options, random);
  BundleOptions bundle_options;
  bundle_options.function_tolerance = 1e-6 * static_cast<double>(state.range(3));
  BundleResult result;
  for (auto _ : state) {
    BundleProblem problem = scene.start;
    result = adjust_bundle(problem, bundle_options);
  }
  state.counters["iterations"] = result.iterations;
  state.counters["cost"] = result.final_cost;
}
BENCHMARK(adjust_local_bundle)
    ->Args({20, 15, 3000, 0})
    ->Args({20, 15, 3000, 100})
    ->Args({20, 15, 3000, 10})
    ->Args({60, 50, 9000, 100})
    ->Args({110, 100, 15000, 100})
    ->Unit(benchmark::kMillisecond);

/// poses on a drifted round with as many neighbours joined as state.range(1) says, and one loop edge
void optimize_loop(benchmark::State& state) {
  Random random(3);
  const auto n = static_cast<std::size_t>(state.range(0));
  const auto neighbours = static_cast<std::size_t>(state.range(1));
  std::vector<SE3> truth{SE3()};
  PoseGraph start;
  start.cam_from_world.emplace_back();
  Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
  step.z() = -0.12;
  step[4] = 2.0 * std::numbers::pi / static_cast<double>(n);
  for (std::size_t i = 1; i < n; ++i) {
    truth.push_back(SE3::exp(step) * truth.back());
    const SE3 drifted = SE3::exp(scenes::random_twist(0.003, 0.001, random)) * SE3::exp(step);
    start.cam_from_world.push_back(drifted * start.cam_from_world.back());
    for (std::size_t j = i > neighbours ? i - neighbours : 0; j < i; ++j) {
      start.edges.push_back({static_cast<int>(j), static_cast<int>(i),
                             start.cam_from_world[i] * start.cam_from_world[j].inverse()});
    }
  }
  start.edges.push_back({static_cast<int>(n) - 1, 0, truth.front() * truth.back().inverse()});
  start.pose_fixed.assign(n, 0);
  start.pose_fixed[0] = 1;
  PoseGraphResult result;
  for (auto _ : state) {
    PoseGraph graph = start;
    result = optimize_pose_graph(graph, {});
  }
  state.counters["edges"] = static_cast<double>(start.edges.size());
  state.counters["iterations"] = result.iterations;
}
BENCHMARK(optimize_loop)->Args({300, 8})->Args({500, 4})->Args({1000, 8})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cpslam
