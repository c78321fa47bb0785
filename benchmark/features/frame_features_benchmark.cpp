#include <benchmark/benchmark.h>

#include "benchmark_data.h"
#include "camera/pinhole_camera.h"
#include "features/frame_features.h"
#include "features/keypoint_depth.h"

namespace cpslam {
namespace {

CameraSettings desk_camera() {
  CameraSettings s;
  s.fx = 517.306408;
  s.fy = 516.469215;
  s.cx = 318.643040;
  s.cy = 255.313989;
  s.k1 = 0.262383;
  s.k2 = -0.953104;
  s.p1 = -0.005358;
  s.p2 = 0.002628;
  s.k3 = 1.163314;
  return s;
}

void BuildFrameFeatures(benchmark::State& state) {
  const std::vector<bench::BenchmarkFrame> frames = bench::load_frames(10);
  FrameFeaturesBuilder builder(desk_camera(), {});
  std::size_t i = 0;
  for (auto _ : state) {
    const bench::BenchmarkFrame& frame = frames[i++ % frames.size()];
    benchmark::DoNotOptimize(builder.build(frame.grey, frame.depth));
  }
}
BENCHMARK(BuildFrameFeatures)->Unit(benchmark::kMillisecond)->UseRealTime();

void UndistortKeypoints(benchmark::State& state) {
  const bench::BenchmarkFrame frame = bench::load_frames(1000).front();
  OrbFeatures found;
  OrbExtractor(OrbSettings{}).extract(frame.grey, found);
  const PinholeCamera camera(desk_camera());
  for (auto _ : state) {
    for (const OrbKeypoint& k : found.keypoints) {
      benchmark::DoNotOptimize(camera.undistort({static_cast<double>(k.x), static_cast<double>(k.y)}));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(found.keypoints.size()));
}
BENCHMARK(UndistortKeypoints)->Unit(benchmark::kMillisecond);

void ReadKeypointDepths(benchmark::State& state) {
  const bench::BenchmarkFrame frame = bench::load_frames(1000).front();
  OrbFeatures found;
  OrbExtractor(OrbSettings{}).extract(frame.grey, found);
  for (auto _ : state) {
    for (const OrbKeypoint& k : found.keypoints) {
      benchmark::DoNotOptimize(
          read_keypoint_depth(frame.depth, 1.0 / 5000.0, static_cast<int>(k.x), static_cast<int>(k.y)));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(found.keypoints.size()));
}
BENCHMARK(ReadKeypointDepths)->Unit(benchmark::kMillisecond);

/// Argument: radius of the window, px. One query around every keypoint.
void QueryGrid(benchmark::State& state) {
  const bench::BenchmarkFrame frame = bench::load_frames(1000).front();
  const auto features = FrameFeaturesBuilder(desk_camera(), {}).build(frame.grey, frame.depth);
  std::vector<int> found;
  for (auto _ : state) {
    for (const Keypoint& k : features->keypoints) {
      found.clear();
      features->grid.query(k.x, k.y, static_cast<float>(state.range(0)), k.octave - 1, k.octave + 1, found);
      benchmark::DoNotOptimize(found.data());
    }
  }
  state.SetItemsProcessed(state.iterations() * features->size());
}
BENCHMARK(QueryGrid)->Arg(7)->Arg(15)->Arg(40);

}  // namespace
}  // namespace cpslam
