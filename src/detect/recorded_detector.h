#pragma once

#include <string>
#include <vector>

#include "cpslam/person_detector.h"
#include "io/person_boxes.h"

namespace cpslam {

/// Boxes from a file (io/person_boxes.h): those whose stamp is nearest to the image's, within 1 ms. An image
/// without a line shows nobody. Immutable.
class RecordedDetector : public PersonDetector {
 public:
  /// Throws InputError naming file and line.
  explicit RecordedDetector(const std::string& path);
  /// frames: in the order of their stamps. name: for messages.
  RecordedDetector(std::vector<StampedBoxes> frames, std::string name);

  [[nodiscard]] std::vector<PersonBox> detect(const cv::Mat& colour, double time_s) override;
  [[nodiscard]] std::string name() const override { return name_; }

 private:
  std::vector<StampedBoxes> frames_;
  std::string name_;
};

}  // namespace cpslam
