#include <benchmark/benchmark.h>

#include "benchmark_data.h"
#include "camera/pinhole_camera.h"
#include "features/frame_features.h"
#include "features/keypoint_depth.h"
#include "support/tum_cameras.h"

namespace cpslam {
namespace {

void BuildFrameFeatures(benchmark::State& state) {
  const std::vector<bench::BenchmarkFrame> frames = bench::load_frames(10);
  FrameFeaturesBuilder builder(tum1_camera(), {});
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
  const PinholeCamera camera(tum1_camera());
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
  const auto features = FrameFeaturesBuilder(tum1_camera(), {}).build(frame.grey, frame.depth);
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
