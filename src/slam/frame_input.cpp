#include "slam/frame_input.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "cpslam/error.h"

namespace cpslam {
namespace {

std::string size_text(const cv::Mat& image) {
  return std::to_string(image.cols) + "x" + std::to_string(image.rows);
}

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

void check_images(const cv::Mat& colour, const cv::Mat& depth, const CameraSettings& camera) {
  if (colour.empty()) throw InputError("the colour image is empty");
  if (depth.empty()) throw InputError("the depth image is empty");
  if (colour.type() != CV_8UC3 && colour.type() != CV_8UC1) {
    throw InputError("the colour image must have 8 bits in one or three channels");
  }
  if (depth.type() != CV_16UC1 && depth.type() != CV_32FC1) {
    throw InputError("the depth image must have 16-bit integers or 32-bit floats in one channel");
  }
  if (colour.size() != depth.size()) {
    throw InputError("the colour image is " + size_text(colour) + " and the depth image " + size_text(depth) +
                     ": depth must be registered to colour");
  }
  if (colour.cols != camera.width || colour.rows != camera.height) {
    throw InputError("the images are " + size_text(colour) +
                     ", but the settings' Camera.width and Camera.height say " +
                     std::to_string(camera.width) + "x" + std::to_string(camera.height));
  }
}

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
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return static_cast<double>(*middle) / depth_map_factor;
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
