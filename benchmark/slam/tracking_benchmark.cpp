#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <opencv2/features2d.hpp>
#include <vector>

#include "benchmark_data.h"
#include "cpslam/system.h"
#include "io/image_reader.h"
#include "io/tum_sequence.h"
#include "sim/simulation.h"
#include "util/median.h"

namespace cpslam {
namespace {

struct Clip {
  Settings settings;
  std::vector<RgbdImages> frames;
};

/// fr1_desk_dev where it is there, else a simulated office.
Clip load_clip() {
  Clip clip;
  const std::filesystem::path desk = shared_data_dir() / "fr1_desk_dev";
  if (std::filesystem::is_directory(desk)) {
    clip.settings = load_settings(CPSLAM_SOURCE_DIR "/Examples/RGB-D/TUM1.yaml");
    for (const RgbdEntry& entry : associate_sequence(desk.string())) clip.frames.push_back(read_rgbd(entry));
    return clip;
  }
  sim::SimulationOptions options;
  options.sensor_noise = true;
  options.n_frames = 100;
  sim::Simulation simulation(options);
  clip.settings = simulation.settings();
  for (int i = 0; i < simulation.size(); ++i) {
    const sim::SimulatedFrame frame = simulation.render(i);
    clip.frames.push_back({frame.time_s, frame.time_s, frame.colour_bgr, frame.depth, {}});
  }
  return clip;
}

// Both benchmarks go over the whole clip once and report the median time of a frame, so that their ratio is
// that of whole tracking to the extraction alone on the very same pictures.

void OpenCvOrb(benchmark::State& state) {
  const Clip clip = load_clip();
  const auto orb = cv::ORB::create(1000, 1.2F, 8);
  for (auto _ : state) {
    std::vector<double> times_s;
    for (const RgbdImages& frame : clip.frames) {
      cv::Mat grey;
      cv::cvtColor(frame.colour, grey, cv::COLOR_BGR2GRAY);
      std::vector<cv::KeyPoint> keypoints;
      cv::Mat descriptors;
      const auto start = std::chrono::steady_clock::now();
      orb->detectAndCompute(grey, cv::noArray(), keypoints, descriptors);
      times_s.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    state.SetIterationTime(median(times_s));
  }
}
BENCHMARK(OpenCvOrb)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);

/// System::track less the waiting for the mapper; the argument is 1 for the sequential mode.
void TrackFrame(benchmark::State& state) {
  Clip clip = load_clip();
  clip.settings.sequential = state.range(0) == 1;
  for (auto _ : state) {
    System system(clip.settings);
    for (const RgbdImages& frame : clip.frames) system.track(frame.colour, frame.depth, frame.time_s);
    const Statistics statistics = system.statistics();
    const auto track = std::find_if(statistics.stages.begin(), statistics.stages.end(),
                                    [](const StageTimes& stage) { return stage.stage == "track"; });
    state.SetIterationTime(track->p50_ms / 1000.0);
  }
}
BENCHMARK(TrackFrame)
    ->ArgName("sequential")
    ->Arg(0)
    ->Arg(1)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cpslam
