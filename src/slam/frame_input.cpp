#include "slam/frame_input.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "util/median.h"

namespace cpslam {
namespace {

template <typename Value>
std::vector<float> valid_samples(const cv::Mat& depth) {
  constexpr int kStep = 4;  // px; a sixteenth of the readings is plenty for a median
  std::vector<float> samples;
  for (int y = 0; y < depth.rows; y += kStep) {
    const auto* row = depth.ptr<Value>(y);
    for (int x = 0; x < depth.cols; x += kStep) {
      const auto value = static_cast<float>(row[x]);
      if (std::isfinite(value) && value > 0.0F) samples.push_back(value);
    }
  }
  return samples;
}

}  // namespace

cv::Mat to_grey(const cv::Mat& colour) {
  if (colour.channels() == 1) return colour;
  cv::Mat grey;
  cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

double median_depth_m(const cv::Mat& depth, double depth_map_factor) {
  std::vector<float> samples =
      depth.type() == CV_16UC1 ? valid_samples<std::uint16_t>(depth) : valid_samples<float>(depth);
  if (samples.empty()) return 0.0;
  return static_cast<double>(median(samples)) / depth_map_factor;
}

void warn_about_depth_scale(const cv::Mat& depth, double depth_map_factor, const Log& log) {
  constexpr double kNearestPlausibleM = 0.3;
  constexpr double kFarthestPlausibleM = 10.0;
  const double median_m = median_depth_m(depth, depth_map_factor);
  if (median_m == 0.0) {
    log.warning("the first depth image has no valid reading");
  } else if (median_m < kNearestPlausibleM || median_m > kFarthestPlausibleM) {
    log.warning("the median depth of the first image is " + std::to_string(median_m) +
                " m with DepthMapFactor: " + std::to_string(depth_map_factor) +
                "; check that key (depth image units per metre: TUM and Bonn 5000, millimetres 1000)");
  }
}

}  // namespace cpslam
