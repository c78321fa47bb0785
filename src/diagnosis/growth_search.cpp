#include "diagnosis/growth_search.h"

#include <algorithm>
#include <cstddef>
#include <opencv2/imgproc.hpp>

#include "diagnosis/edge_comparison.h"

namespace cpslam::diagnosis {
namespace {

constexpr std::size_t kSteps = 12;  // to either side
constexpr double kStep = 0.01;
constexpr int kReducedWidth = 320;  // px

double growth_of(std::size_t step) {
  return kStep * (static_cast<double>(step) - static_cast<double>(kSteps));
}

}  // namespace

void GrowthSearch::add(const cv::Mat& grey, const cv::Mat& readings) {
  cv::Mat small_grey, small_readings;
  const double scale = std::min(1.0, static_cast<double>(kReducedWidth) / grey.cols);
  cv::resize(grey, small_grey, {}, scale, scale, cv::INTER_AREA);
  cv::resize(readings, small_readings, small_grey.size(), 0.0, 0.0, cv::INTER_NEAREST);
  if (maps_.empty()) maps_.assign(2 * kSteps + 1, EdgeComparison::make_map(small_grey.size()));
  const EdgeComparison comparison(small_grey, small_readings);
  for (std::size_t i = 0; i < maps_.size(); ++i) comparison.add_to(maps_[i], growth_of(i));
}

std::optional<DepthGrowth> GrowthSearch::best() const {
  std::optional<DepthGrowth> best;
  double highest = 0.0, unchanged = 0.0;
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    const std::optional<AgreementPeak> peak = maps_[i].peak();
    if (!peak) continue;
    if (i == kSteps) unchanged = peak->height;
    if (best && peak->height <= highest) continue;
    highest = peak->height;
    best = DepthGrowth{growth_of(i), 0.0, peak->contrast};
  }
  if (best) best->gain = highest / std::max(unchanged, 1e-3 * highest);
  return best;
}

}  // namespace cpslam::diagnosis
