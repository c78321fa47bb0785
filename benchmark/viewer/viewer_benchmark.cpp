// What the viewer costs: run it on a display, or under xvfb-run for software OpenGL.
#include <benchmark/benchmark.h>

#include "map/map_builder.h"
#include "slam/map_snapshot.h"
#include "viewer/sample_scene.h"
#include "viewer/viewer.h"

namespace cpslam::viewer {
namespace {

/// A window of 1600 x 900 with this many map points, drawn over and over.
void draw_window(benchmark::State& state) {
  const auto board = std::make_shared<SnapshotBoard>();
  board->publish(
      std::make_shared<const MapSnapshot>(sample::map(static_cast<std::size_t>(state.range(0)), 300)));
  board->publish(std::make_shared<const FrameSnapshot>(sample::frame(100)));
  ViewerOptions options;
  options.camera = sample::camera();
  RunControl control;
  Viewer viewer(options, board, control);
  for (auto _ : state) viewer.draw_once();
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(draw_window)
    ->Arg(0)
    ->Arg(10000)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// A new frame and a new map on the board before each drawing.
void take_and_draw(benchmark::State& state) {
  const auto board = std::make_shared<SnapshotBoard>();
  const auto map = sample::map(static_cast<std::size_t>(state.range(0)), 300);
  ViewerOptions options;
  options.camera = sample::camera();
  RunControl control;
  Viewer viewer(options, board, control);
  std::uint64_t index = 0;
  for (auto _ : state) {
    state.PauseTiming();
    board->publish(std::make_shared<const MapSnapshot>(map));
    board->publish(std::make_shared<const FrameSnapshot>(sample::frame(++index)));
    state.ResumeTiming();
    viewer.draw_once();
  }
}
BENCHMARK(take_and_draw)->Arg(100000)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// What tracking waits for while the map is copied: points
void copy_map(benchmark::State& state) {
  constexpr std::size_t kPerKeyFrame = 500;
  Map map{synthetic::pyramid()};
  const auto n_points = static_cast<std::size_t>(state.range(0));
  for (std::size_t first = 0; first < n_points; first += kPerKeyFrame) {
    const KeyFrameId keyframe = test::add_keyframe(map, test::blank_features(kPerKeyFrame));
    for (std::size_t i = 0; i < kPerKeyFrame; ++i)
      map.add_point({0.01 * static_cast<double>(i), 0.0, 2.0}, {keyframe, static_cast<int>(i)});
  }
  for (auto _ : state) benchmark::DoNotOptimize(copy_for_viewer(map));
}
BENCHMARK(copy_map)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cpslam::viewer
