#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "features/simd.h"
#include "support/shared_data.h"
#include "util/random.h"

namespace cpslam::test {

/// The instruction sets this machine can run.
inline std::vector<Simd> simds() {
  if (cpu_has_avx2()) return {Simd::kBaseline, Simd::kAvx2};
  return {Simd::kBaseline};
}

inline cv::Mat noise_image(int width, int height, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random.index(256));
  }
  return image;
}

/// Overlapping rectangles of random greys on a slope of light, with a little noise: corners of all contrasts.
inline cv::Mat textured_image(int width, int height, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(80 + 60 * x / width);
  }
  const int n = width * height / 600;
  for (int i = 0; i < n; ++i) {
    const cv::Point corner(static_cast<int>(random.uniform(-20.0, width)),
                           static_cast<int>(random.uniform(-20.0, height)));
    const cv::Size size(static_cast<int>(random.uniform(5.0, 60.0)),
                        static_cast<int>(random.uniform(5.0, 60.0)));
    cv::rectangle(image, cv::Rect(corner, size), cv::Scalar(random.uniform(0.0, 255.0)), cv::FILLED);
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      auto& grey = image.at<std::uint8_t>(y, x);
      grey = cv::saturate_cast<std::uint8_t>(grey + 2.0 * random.normal());
    }
  }
  return image;
}

/// Grey frames of the clip fr1_desk_dev, every `stride`-th; empty when the clip is not on this machine.
inline std::vector<cv::Mat> desk_frames(std::size_t stride) {
  const std::filesystem::path folder = shared_data_dir() / "fr1_desk_dev/rgb";
  std::vector<std::string> paths;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<cv::Mat> frames;
  for (std::size_t i = 0; i < paths.size(); i += stride)
    frames.push_back(cv::imread(paths[i], cv::IMREAD_GRAYSCALE));
  return frames;
}

}  // namespace cpslam::test
