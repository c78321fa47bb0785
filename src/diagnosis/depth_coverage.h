#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "diagnosis/frame_check.h"

namespace cpslam::diagnosis {

/// How much of the picture has depth, and where it has none.
class DepthCoverageCheck : public FrameCheck {
 public:
  void add(const ExaminedFrame& frame) override;
  [[nodiscard]] Findings findings() const override;

 private:
  static constexpr std::size_t kSide = 3;  // regions across and down

  [[nodiscard]] Finding overall() const;

  std::vector<double> shares_;                       // of valid pixels, by frame
  std::array<double, kSide * kSide> region_sums_{};  // of the regions' shares
};

}  // namespace cpslam::diagnosis
