#include "diagnosis/depth_coverage.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "diagnosis/percentile.h"
#include "util/format_text.h"

namespace cpslam::diagnosis {
namespace {

constexpr std::array kRegionNames{"top left", "top",         "top right", "left",        "middle",
                                  "right",    "bottom left", "bottom",    "bottom right"};
constexpr double kFewShare = 0.2;  // of the picture

}  // namespace

void DepthCoverageCheck::add(const ExaminedFrame& frame) {
  constexpr int side = static_cast<int>(kSide);
  const cv::Size size = frame.readings.size();
  shares_.push_back(static_cast<double>(cv::countNonZero(frame.readings)) /
                    static_cast<double>(frame.readings.total()));
  for (std::size_t i = 0; i < region_sums_.size(); ++i) {
    const int row = static_cast<int>(i) / side, column = static_cast<int>(i) % side;
    const cv::Rect box(cv::Point(size.width * column / side, size.height * row / side),
                       cv::Point(size.width * (column + 1) / side, size.height * (row + 1) / side));
    if (box.empty()) continue;
    region_sums_[i] += static_cast<double>(cv::countNonZero(frame.readings(box))) / box.area();
  }
}

Finding DepthCoverageCheck::overall() const {
  const double median_share = percentile(shares_, 0.5);
  const auto few = static_cast<double>(
      std::count_if(shares_.begin(), shares_.end(), [](double share) { return share < kFewShare; }));
  const double few_share = few / static_cast<double>(shares_.size());
  const double least = *std::min_element(shares_.begin(), shares_.end());
  Finding finding{Level::kOk,
                  "valid depth",
                  format_text("%.0f %% of the pixels have depth (median; the worst frame %.0f %%)",
                              100.0 * median_share, 100.0 * least),
                  "",
                  {{"median_share", median_share}, {"least_share", least}, {"poor_frames_share", few_share}}};
  if (median_share < kFewShare) {
    finding.level = Level::kError;
    finding.advice =
        "too little to track by: keep 0.5-4 m away from things, out of sunlight; check that the "
        "depth images are not empty";
  } else if (median_share < 0.4) {
    finding.level = Level::kWarning;
    finding.advice =
        "keep 0.5-4 m away from things; sunlight, glass, black and glossy surfaces give no depth";
  } else if (few_share > 0.05) {
    finding.level = Level::kWarning;
    finding.what +=
        format_text("; %.0f %% of the frames have less than %.0f %%", 100.0 * few_share, 100.0 * kFewShare);
    finding.advice = "the camera came too close or lost its projector there: SLAM lives on its map meanwhile";
  }
  return finding;
}

Findings DepthCoverageCheck::findings() const {
  if (shares_.empty()) return {};
  Findings findings{overall()};
  const auto least = std::min_element(region_sums_.begin(), region_sums_.end());
  const auto n = static_cast<double>(shares_.size());
  const double least_share = *least / n;
  const double most_share = *std::max_element(region_sums_.begin(), region_sums_.end()) / n;
  if (least_share < 0.1 && most_share > 0.5) {
    findings.push_back(
        {Level::kNote,
         "valid depth",
         format_text("the %s ninth of the picture has depth in %.0f %% of its pixels",
                     kRegionNames[static_cast<std::size_t>(least - region_sums_.begin())],
                     100.0 * least_share),
         "if nothing dark, shiny or far away was there all the time, look for something on the lens",
         {{"least_region_share", least_share}}});
  }
  return findings;
}

}  // namespace cpslam::diagnosis
