#include "diagnosis/sharpness.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "diagnosis/percentile.h"
#include "util/format_text.h"

namespace cpslam::diagnosis {
namespace {

/// Differences between pixels `step` bytes apart: how much of them is left in the blurred picture.
double left_over(const cv::Mat& grey, const cv::Mat& blurred, cv::Point step) {
  long long all = 0, lost = 0;
  for (int y = step.y; y < grey.rows; ++y) {
    const auto* here = grey.ptr<unsigned char>(y);
    const auto* before = grey.ptr<unsigned char>(y - step.y) - step.x;
    const auto* blurred_here = blurred.ptr<unsigned char>(y);
    const auto* blurred_before = blurred.ptr<unsigned char>(y - step.y) - step.x;
    for (int x = step.x; x < grey.cols; ++x) {
      const int difference = std::abs(here[x] - before[x]);
      const int blurred_difference = std::abs(blurred_here[x] - blurred_before[x]);
      all += difference;
      lost += std::max(0, difference - blurred_difference);
    }
  }
  return all == 0 ? 1.0 : static_cast<double>(all - lost) / static_cast<double>(all);
}

}  // namespace

double blur_of(const cv::Mat& grey) {
  constexpr int kTaps = 9;
  cv::Mat across, down;
  cv::blur(grey, across, {kTaps, 1});
  cv::blur(grey, down, {1, kTaps});
  return std::max(left_over(grey, across, {1, 0}), left_over(grey, down, {0, 1}));
}

void SharpnessCheck::add(const ExaminedFrame& frame) {
  // Grain of the sensor would pass for sharpness.
  cv::Mat smooth;
  cv::resize(frame.grey, smooth, {}, 0.5, 0.5, cv::INTER_AREA);
  blurs_.push_back(blur_of(smooth));
}

Findings SharpnessCheck::findings() const {
  if (blurs_.empty()) return {};
  constexpr double kBlurred = 0.5, kUnsharp = 0.55;
  const double sharpest = percentile(blurs_, 0.1), median = percentile(blurs_, 0.5);
  const auto n_blurred = static_cast<double>(
      std::count_if(blurs_.begin(), blurs_.end(), [](double blur) { return blur > kBlurred; }));
  const double share = n_blurred / static_cast<double>(blurs_.size());
  Finding finding{
      Level::kOk,
      "sharpness",
      format_text("blur %.2f of 1 (median), %.0f %% of the frames blurred", median, 100.0 * share),
      "",
      {{"median_blur", median}, {"sharpest_blur", sharpest}, {"blurred_share", share}}};
  if (sharpest > kUnsharp) {
    finding.level = Level::kWarning;
    finding.what += ": even the sharpest are";
    finding.advice = "focus the lens, clean it, and check that the pictures were not enlarged or smoothed";
  } else if (share > 0.25) {
    finding.level = Level::kWarning;
    finding.advice = "move more slowly, or shorten the exposure with more light";
  } else if (share > 0.05) {
    finding.level = Level::kNote;
    finding.advice = "quick turns blur the picture; tracking may be lost there for a moment";
  }
  return {finding};
}

}  // namespace cpslam::diagnosis
