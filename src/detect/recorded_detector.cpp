#include "detect/recorded_detector.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cpslam {
namespace {

/// 1 ms, and the last digit of the six that stamps are written with.
constexpr double kMaxDifferenceS = 0.001 + 1e-6;

}  // namespace

RecordedDetector::RecordedDetector(const std::string& path)
    : RecordedDetector(read_person_boxes(path), "boxes of " + path) {}

RecordedDetector::RecordedDetector(std::vector<StampedBoxes> frames, std::string name)
    : frames_(std::move(frames)), name_(std::move(name)) {}

std::vector<PersonBox> RecordedDetector::detect(const cv::Mat& /*colour*/, double time_s) {
  const auto later =
      std::lower_bound(frames_.begin(), frames_.end(), time_s,
                       [](const StampedBoxes& frame, double stamp) { return frame.time_s < stamp; });
  const auto difference = [&](auto frame) { return std::abs(frame->time_s - time_s); };
  auto nearest = later;
  if (later != frames_.begin() &&
      (later == frames_.end() || difference(std::prev(later)) <= difference(later))) {
    nearest = std::prev(later);
  }
  if (nearest == frames_.end() || difference(nearest) > kMaxDifferenceS) return {};
  return nearest->boxes;
}

}  // namespace cpslam
