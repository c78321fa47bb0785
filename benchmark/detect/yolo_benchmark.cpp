#include <benchmark/benchmark.h>

#include <opencv2/imgcodecs.hpp>

#include "benchmark_data.h"
#include "detect/yolo_detector.h"

// One detection: letterbox, network, decoding. Needs the reference detector and the crowd clip in
// shared_data_dir().

namespace cpslam {
namespace {

/// The reference detector, calibrated on the crowd clip; empty paths when they are not there.
DetectorSettings reference_detector(const benchmark::State& state) {
  const std::filesystem::path model =
      shared_data_dir() / "reference_detectors/yolo-fastest-1.1-xl/yolo-fastest-1.1-xl";
  DetectorSettings settings;
  settings.quantise = state.range(0) == 1;
  settings.calibration = (shared_data_dir() / "bonn_crowd_dev/rgb").string();
  if (!std::filesystem::exists(model.string() + ".cfg") || bench::files_in(settings.calibration).empty()) {
    return {};
  }
  settings.kind = DetectorKind::kYolo;
  settings.model_cfg = model.string() + ".cfg";
  settings.model_weights = model.string() + ".weights";
  return settings;
}

bool is_there(const DetectorSettings& settings, benchmark::State& state) {
  if (settings.kind == DetectorKind::kYolo) return true;
  state.SkipWithError("the reference detector or the clip bonn_crowd_dev is not there");
  return false;
}

/// Argument 0: 0 in floats, 1 in 8-bit integers. 1: OpenCV's threads.
void detect(benchmark::State& state) {
  DetectorSettings settings = reference_detector(state);
  if (!is_there(settings, state)) return;
  settings.n_threads = static_cast<int>(state.range(1));
  YoloDetector detector(settings, Log());
  const std::vector<std::string> files = bench::files_in(settings.calibration);
  std::vector<cv::Mat> images;
  for (std::size_t i = 0; i < files.size(); i += 40) images.push_back(cv::imread(files[i]));
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(detector.detect(images[next], 0.0));
    next = (next + 1) % images.size();
  }
  state.SetLabel(detector.name());
}

BENCHMARK(detect)
    ->ArgNames({"int8", "threads"})
    ->ArgsProduct({{0, 1}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// The start of a detector, with and without calibration.
void start(benchmark::State& state) {
  const DetectorSettings settings = reference_detector(state);
  if (!is_there(settings, state)) return;
  for (auto _ : state) benchmark::DoNotOptimize(YoloDetector(settings, Log()).name());
}

BENCHMARK(start)->ArgName("int8")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace cpslam
