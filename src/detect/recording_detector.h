#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "cpslam/person_detector.h"
#include "io/person_boxes.h"

namespace cpslam {

/// Passes another detector's results through and keeps them, to be written to a file. What that detector
/// throws passes through too, and nothing is kept.
class RecordingDetector : public PersonDetector {
 public:
  explicit RecordingDetector(std::unique_ptr<PersonDetector> detector);

  [[nodiscard]] std::vector<PersonBox> detect(const cv::Mat& colour, double time_s) override;
  [[nodiscard]] std::string name() const override { return detector_->name(); }

  /// All results so far in the order of their stamps, images without a person included; of two results for
  /// one stamp the later. Thread-safe, also while detect() runs.
  [[nodiscard]] std::vector<StampedBoxes> recorded() const;

 private:
  std::unique_ptr<PersonDetector> detector_;
  mutable std::mutex mutex_;  // guards boxes_
  std::map<double, std::vector<PersonBox>> boxes_;
};

}  // namespace cpslam
