// The acceptance number is the counter "ratio" of ExtractBesideOpenCv: median time of OrbExtractor::extract
// over the median of cv::ORB::detectAndCompute, both run in turn on the same frames. ExtractWithPrior
// compares extraction with people covering a share of the image with extraction without them in the same way.
#include <benchmark/benchmark.h>

#include <chrono>
#include <opencv2/features2d.hpp>

#include "benchmark_data.h"
#include "features/orb_extractor.h"

namespace cpslam {
namespace {

template <typename Work>
double milliseconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Argument: OpenCV's threads; 0 for as many as it takes by itself.
void ExtractBesideOpenCv(benchmark::State& state) {
  const int threads_before = cv::getNumThreads();
  if (state.range(0) > 0) cv::setNumThreads(static_cast<int>(state.range(0)));
  const std::vector<bench::BenchmarkFrame> frames = bench::load_frames(10);
  const auto orb = cv::ORB::create(1000, 1.2F, 8);
  OrbExtractor extractor{OrbSettings{}};
  OrbFeatures features;
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  constexpr double kLong = 1e9;
  std::vector<double> ours_ms(frames.size(), kLong);
  std::vector<double> opencv_ms(frames.size(), kLong);
  std::size_t n_keypoints = 0;
  for (auto _ : state) {
    n_keypoints = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const cv::Mat& grey = frames[i].grey;
      ours_ms[i] = std::min(ours_ms[i], milliseconds([&] { extractor.extract(grey, features); }));
      opencv_ms[i] =
          std::min(opencv_ms[i],
                   milliseconds([&] { orb->detectAndCompute(grey, cv::noArray(), keypoints, descriptors); }));
      n_keypoints += features.keypoints.size();
    }
  }
  state.counters["keypoints"] = static_cast<double>(n_keypoints) / static_cast<double>(frames.size());
  state.counters["ours_ms"] = median(ours_ms);
  state.counters["opencv_ms"] = median(opencv_ms);
  state.counters["ratio"] = median(ours_ms) / median(opencv_ms);
  cv::setNumThreads(threads_before);
}
BENCHMARK(ExtractBesideOpenCv)->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond)->Iterations(15)->UseRealTime();

/// A column of people in the middle, as a coarse mask.
cv::Mat people_mask(cv::Size image_size, double share) {
  cv::Mat mask = cv::Mat::zeros(image_size.height / 4, image_size.width / 4, CV_8UC1);
  const int width = static_cast<int>(share * mask.cols);
  mask.colRange((mask.cols - width) / 2, (mask.cols + width) / 2).setTo(1);
  return mask;
}

/// Argument: share of the image that is people, per cent.
void ExtractWithPrior(benchmark::State& state) {
  const int threads_before = cv::getNumThreads();
  cv::setNumThreads(1);
  const std::vector<bench::BenchmarkFrame> frames = bench::load_frames(10);
  OrbExtractor extractor{OrbSettings{}};
  OrbFeatures features;
  const ExtractionPrior prior{
      .people = people_mask(frames.front().grey.size(), static_cast<double>(state.range(0)) / 100.0)};
  constexpr double kLong = 1e9;
  std::vector<double> plain_ms(frames.size(), kLong);
  std::vector<double> prior_ms(frames.size(), kLong);
  std::vector<double> more_ms(frames.size(), kLong);
  for (auto _ : state) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const cv::Mat& grey = frames[i].grey;
      prior_ms[i] = std::min(prior_ms[i], milliseconds([&] { extractor.extract(grey, features, prior); }));
      plain_ms[i] = std::min(plain_ms[i], milliseconds([&] { extractor.extract(grey, features); }));
      more_ms[i] =
          std::min(more_ms[i], milliseconds([&] { extractor.extract_more(prior.people, 300, features); }));
    }
  }
  state.counters["plain_ms"] = median(plain_ms);
  state.counters["prior_ms"] = median(prior_ms);
  state.counters["ratio"] = median(prior_ms) / median(plain_ms);
  state.counters["more_ms"] = median(more_ms);
  cv::setNumThreads(threads_before);
}
BENCHMARK(ExtractWithPrior)
    ->Arg(10)
    ->Arg(40)
    ->Arg(70)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(15)
    ->UseRealTime();

}  // namespace
}  // namespace cpslam
