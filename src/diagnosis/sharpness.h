#pragma once

#include <vector>

#include "diagnosis/frame_check.h"

namespace cpslam::diagnosis {

/// How blurred a grey picture is whatever it shows, from 0 (sharp) to 1: how little of the difference between
/// neighbouring pixels one more blur takes away, in the direction where it takes least (Crete et al. 2007,
/// "The blur effect"). 1 for a picture without any difference.
[[nodiscard]] double blur_of(const cv::Mat& grey);

/// Pictures blurred by motion, and lenses out of focus.
class SharpnessCheck : public FrameCheck {
 public:
  void add(const ExaminedFrame& frame) override;
  [[nodiscard]] Findings findings() const override;

 private:
  std::vector<double> blurs_;  // by frame
};

}  // namespace cpslam::diagnosis
