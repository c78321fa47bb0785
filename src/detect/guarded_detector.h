#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cpslam/person_detector.h"
#include "detect/counted_messages.h"
#include "util/stage_timer.h"

namespace cpslam {

/// A PersonDetector whose failures are reported instead of thrown, and whose time is taken as the stage
/// "detect". Used from one thread.
class GuardedDetector {
 public:
  GuardedDetector(std::unique_ptr<PersonDetector> detector, StageTimer& timer, const Log& log);

  /// Nothing when the detector threw.
  [[nodiscard]] std::optional<std::vector<PersonBox>> detect(const cv::Mat& colour, double time_s);
  /// The detector's; may be read from any thread.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  void report(double time_s, const std::string& failure);

  const std::unique_ptr<PersonDetector> detector_;
  const std::string name_;
  StageTimer& timer_;
  CountedMessages failures_;
};

}  // namespace cpslam
