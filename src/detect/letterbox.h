#pragma once

#include <opencv2/core.hpp>

#include "cpslam/types.h"

namespace cpslam {

/// Fits images of one size into a network's input: scaled with their aspect kept, centred, the rest grey.
/// Immutable.
class Letterbox {
 public:
  /// Both sizes in px, positive.
  Letterbox(cv::Size image, cv::Size input);

  /// image: of the size given to the constructor, 8-bit, any number of channels. Returns a picture of the
  /// input's size.
  [[nodiscard]] cv::Mat fit(const cv::Mat& image) const;

  /// A box in px of the input, in px of the image.
  [[nodiscard]] PersonBox to_image(const PersonBox& box_in_input) const;

  [[nodiscard]] cv::Size image() const { return image_; }
  /// What of the input shows the image.
  [[nodiscard]] cv::Rect content() const { return content_; }

 private:
  cv::Size image_;
  cv::Size input_;
  cv::Rect content_;
};

}  // namespace cpslam
