#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cpslam/person_detector.h"

namespace cpslam {

/// Two thresholds instead of one, as for edges (Canny 1986) and tracking by detection (ByteTrack, Zhang et
/// al. 2022): of another detector's boxes those stay that are as confident as the higher threshold asks, and
/// of the others those that continue a box that stayed not long before. What is no person seldom looks like
/// one for sure; who is one does so sooner or later, and less when he is half covered.
class HysteresisDetector : public PersonDetector {
 public:
  /// detector: of all boxes from the lower threshold on. first_confidence: the higher threshold.
  HysteresisDetector(std::unique_ptr<PersonDetector> detector, double first_confidence);

  /// time_s: where it goes back, or on by more than kMemoryS, nothing is continued.
  [[nodiscard]] std::vector<PersonBox> detect(const cv::Mat& colour, double time_s) override;
  [[nodiscard]] std::string name() const override { return detector_->name(); }

  static constexpr double kMemoryS = 0.3;

 private:
  struct Known {
    PersonBox box;
    double time_s;
  };

  const std::unique_ptr<PersonDetector> detector_;
  const double first_confidence_;
  std::vector<Known> known_;  // everybody's latest box
};

}  // namespace cpslam
