#include <benchmark/benchmark.h>

#include "optim/bundle_adjuster.h"
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

}  // namespace
}  // namespace cpslam
