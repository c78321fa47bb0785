#pragma once

#include <optional>
#include <vector>

#include "diagnosis/frame_check.h"

namespace cpslam::diagnosis {

/// Whether depths are those of rooms when DepthMapFactor is what it is said to be, and which factor would
/// make them so.
class DepthScaleCheck : public FrameCheck {
 public:
  /// factor: units per metre, empty when nobody has said it yet.
  explicit DepthScaleCheck(std::optional<double> factor) : factor_(factor) {}

  void add(const ExaminedFrame& frame) override;
  [[nodiscard]] Findings findings() const override;

 private:
  const std::optional<double> factor_;
  std::vector<float> readings_;  // a sample of all frames'
};

}  // namespace cpslam::diagnosis
