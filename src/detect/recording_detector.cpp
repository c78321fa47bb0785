#include "detect/recording_detector.h"

#include <utility>

namespace cpslam {

RecordingDetector::RecordingDetector(std::unique_ptr<PersonDetector> detector)
    : detector_(std::move(detector)) {}

std::vector<PersonBox> RecordingDetector::detect(const cv::Mat& colour, double time_s) {
  std::vector<PersonBox> boxes = detector_->detect(colour, time_s);
  const std::scoped_lock lock(mutex_);
  boxes_[time_s] = boxes;
  return boxes;
}

std::vector<StampedBoxes> RecordingDetector::recorded() const {
  const std::scoped_lock lock(mutex_);
  std::vector<StampedBoxes> frames;
  frames.reserve(boxes_.size());
  for (const auto& [time_s, boxes] : boxes_) frames.push_back({time_s, boxes});
  return frames;
}

}  // namespace cpslam
