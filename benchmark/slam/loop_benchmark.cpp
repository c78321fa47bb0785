#include <benchmark/benchmark.h>

#include <mutex>
#include <numbers>

#include "slam/loop_scene.h"
#include "slam/map_correction.h"

namespace cpslam {
namespace {

scene::RoundOptions long_round(benchmark::State& state) {
  scene::RoundOptions options;
  options.keyframes = static_cast<int>(state.range(0));
  options.step_rad = 2.0 * std::numbers::pi / static_cast<double>(options.keyframes - 2);
  options.drift_m = 0.0005;
  options.drift_rad = 0.0003;
  options.points = 8000;
  return options;
}

/// What tracking has to wait for when a loop is closed: keyframes
void move_whole_map(benchmark::State& state) {
  scene::RoundWalk walk(long_round(state));
  MapCorrection correction;
  for (const KeyFrameId id : walk.keyframes) {
    correction.cam_from_world[id] = walk.map.keyframe(id)->cam_from_world;
  }
  for (auto _ : state) {
    const std::unique_lock lock(walk.map.mutex());
    apply_correction(walk.map, correction);
  }
  state.counters["points"] = static_cast<double>(walk.map.n_points());
}
BENCHMARK(move_whole_map)->Arg(100)->Arg(300)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cpslam
