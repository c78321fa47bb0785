#pragma once

#include <algorithm>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "support/shared_data.h"
#include "util/random.h"

namespace cpslam::bench {

/// A grey picture and its raw depth (1/5000 m).
struct BenchmarkFrame {
  cv::Mat grey;
  cv::Mat depth;
};

/// Sorted files of a folder; none when there is no such folder.
inline std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> paths;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// Rectangles of random greys in front of a wall at 2 m.
inline BenchmarkFrame synthetic_frame() {
  Random random(1);
  cv::Mat grey(480, 640, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < 500; ++i) {
    const cv::Point corner(static_cast<int>(random.index(640)), static_cast<int>(random.index(480)));
    const cv::Size size(5 + static_cast<int>(random.index(55)), 5 + static_cast<int>(random.index(55)));
    cv::rectangle(grey, cv::Rect(corner, size), cv::Scalar(random.uniform(0.0, 255.0)), cv::FILLED);
  }
  return {grey, cv::Mat(480, 640, CV_16UC1, cv::Scalar(10000))};
}

/// Every `stride`-th frame of the clip fr1_desk_dev in shared_data_dir(), else one synthetic frame.
inline std::vector<BenchmarkFrame> load_frames(std::size_t stride) {
  const std::filesystem::path data = shared_data_dir();
  const std::vector<std::string> grey = files_in(data / "fr1_desk_dev/rgb");
  const std::vector<std::string> depth = files_in(data / "fr1_desk_dev/depth");
  std::vector<BenchmarkFrame> frames;
  // Pairs by rank, not by stamp: near enough for timing.
  for (std::size_t i = 0; i < std::min(grey.size(), depth.size()); i += stride) {
    frames.push_back({cv::imread(grey[i], cv::IMREAD_GRAYSCALE), cv::imread(depth[i], cv::IMREAD_UNCHANGED)});
  }
  if (frames.empty()) frames.push_back(synthetic_frame());
  return frames;
}

}  // namespace cpslam::bench
