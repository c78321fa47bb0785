#include "detect/hysteresis_detector.h"

#include <algorithm>
#include <utility>

#include "detect/box_overlap.h"

namespace cpslam {
namespace {

constexpr float kSameOverlap = 0.5F;

}  // namespace

HysteresisDetector::HysteresisDetector(std::unique_ptr<PersonDetector> detector, double first_confidence)
    : detector_(std::move(detector)), first_confidence_(first_confidence) {}

std::vector<PersonBox> HysteresisDetector::detect(const cv::Mat& colour, double time_s) {
  std::vector<PersonBox> boxes = detector_->detect(colour, time_s);
  // The surest first: a weak box must not take the place of who is seen well.
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const PersonBox& a, const PersonBox& b) { return a.confidence > b.confidence; });
  std::erase_if(
      known_, [&](const Known& known) { return known.time_s > time_s || time_s - known.time_s > kMemoryS; });
  std::vector<Known> now;
  std::erase_if(boxes, [&](const PersonBox& box) {
    const auto best = std::max_element(known_.begin(), known_.end(), [&](const Known& a, const Known& b) {
      return box_overlap(a.box, box) < box_overlap(b.box, box);
    });
    const bool continues = best != known_.end() && box_overlap(best->box, box) >= kSameOverlap;
    if (!continues && box.confidence < first_confidence_) return true;
    if (continues) known_.erase(best);
    now.push_back({box, time_s});
    return false;
  });
  known_.insert(known_.end(), now.begin(), now.end());
  return boxes;
}

}  // namespace cpslam
