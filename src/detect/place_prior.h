#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "cpslam/types.h"

namespace cpslam {

/// How likely a place in a person's box is to be on the person: he fills the middle, unless the image cuts
/// him off there, and his upper part; tables, monitors and floor are seen below. In (0, 1].
class PlacePrior {
 public:
  PlacePrior(const PersonBox& box, cv::Size image)
      : x_(static_cast<float>(box.x)),
        y_(static_cast<float>(box.y)),
        width_(static_cast<float>(box.width)),
        height_(static_cast<float>(box.height)),
        cut_left_(x_ < kBorderPx),
        cut_right_(x_ + width_ > static_cast<float>(image.width) - kBorderPx) {}

  /// x, y: px of the image.
  [[nodiscard]] float weight(float x, float y) const {
    float off = (x - x_) / width_ - 0.5F;
    if ((off < 0.0F && cut_left_) || (off > 0.0F && cut_right_)) off = 0.0F;
    const float spread = off / kCentreSpread;
    const float below = std::clamp(((y - y_) / height_ - kUpperShare) / (1.0F - kUpperShare), 0.0F, 1.0F);
    return std::exp(-0.5F * spread * spread) * (1.0F - below * (1.0F - kBottomWeight));
  }

 private:
  static constexpr float kBorderPx = 6.0F;  // a box that comes so near to the image's border is cut off there
  static constexpr float kCentreSpread = 0.3F;  // standard deviation of the person's place, in box widths
  static constexpr float kUpperShare = 0.4F;
  static constexpr float kBottomWeight = 0.3F;

  float x_, y_, width_, height_;
  bool cut_left_, cut_right_;
};

}  // namespace cpslam
