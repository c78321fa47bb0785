#include "viewer/mask_overlay.h"

#include <cstdint>
#include <opencv2/core.hpp>

#include "viewer/colours.h"

namespace cpslam::viewer {
namespace {

constexpr std::uint8_t kInside = 95;
constexpr std::uint8_t kOutline = 220;

bool on_outline(const cv::Mat& mask, int x, int y) {
  const auto* const row = mask.ptr<std::uint8_t>(y);
  const std::uint8_t person = row[x];
  return (x > 0 && row[x - 1] != person) || (x + 1 < mask.cols && row[x + 1] != person) ||
         (y > 0 && mask.at<std::uint8_t>(y - 1, x) != person) ||
         (y + 1 < mask.rows && mask.at<std::uint8_t>(y + 1, x) != person);
}

}  // namespace

cv::Mat mask_overlay(const cv::Mat& person_mask) {
  if (person_mask.type() != CV_8UC1 || cv::countNonZero(person_mask) == 0) return {};
  cv::Mat overlay(person_mask.size(), CV_8UC4, cv::Scalar::all(0));
  for (int y = 0; y < person_mask.rows; ++y) {
    const auto* const person = person_mask.ptr<std::uint8_t>(y);
    auto* const pixel = overlay.ptr<cv::Vec4b>(y);
    for (int x = 0; x < person_mask.cols; ++x) {
      if (person[x] == 0) continue;
      const Colour colour = person_colour(person[x]);
      pixel[x] = {colour.red, colour.green, colour.blue, on_outline(person_mask, x, y) ? kOutline : kInside};
    }
  }
  return overlay;
}

}  // namespace cpslam::viewer
