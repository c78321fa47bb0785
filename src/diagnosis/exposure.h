#pragma once

#include <vector>

#include "diagnosis/frame_check.h"

namespace cpslam::diagnosis {

/// Whether colour pictures are too dark or burnt out, and whether their brightness jumps.
class ExposureCheck : public FrameCheck {
 public:
  void add(const ExaminedFrame& frame) override;
  [[nodiscard]] Findings findings() const override;

 private:
  [[nodiscard]] Finding level_finding() const;
  [[nodiscard]] Finding change_finding() const;

  struct Sample {
    double time_s;
    double mean;             // grey level
    double saturated_share;  // of the pixels
  };
  std::vector<Sample> samples_;
};

}  // namespace cpslam::diagnosis
