#include "detect/letterbox.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace cpslam {
namespace {

/// The usual grey of YOLO letterboxes. Measured on 95 frames of bonn_crowd_dev, 0, 114 and 128 differ by one
/// box.
constexpr double kPaddingGrey = 114.0;

int scaled(int side, double scale, int limit) {
  return std::clamp(static_cast<int>(std::lround(side * scale)), 1, limit);
}

}  // namespace

Letterbox::Letterbox(cv::Size image, cv::Size input) : image_(image), input_(input) {
  const double scale = std::min(1.0 * input.width / image.width, 1.0 * input.height / image.height);
  content_.width = scaled(image.width, scale, input.width);
  content_.height = scaled(image.height, scale, input.height);
  content_.x = (input.width - content_.width) / 2;
  content_.y = (input.height - content_.height) / 2;
}

cv::Mat Letterbox::fit(const cv::Mat& image) const {
  cv::Mat picture(input_, image.type(), cv::Scalar::all(kPaddingGrey));
  cv::Mat inside = picture(content_);
  cv::resize(image, inside, content_.size(), 0.0, 0.0, cv::INTER_LINEAR);
  return picture;
}

PersonBox Letterbox::to_image(const PersonBox& box_in_input) const {
  // Rounding to whole px may scale the two sides a little differently.
  const double image_px_x = 1.0 * image_.width / content_.width;
  const double image_px_y = 1.0 * image_.height / content_.height;
  PersonBox box = box_in_input;
  box.x = (box_in_input.x - content_.x) * image_px_x;
  box.y = (box_in_input.y - content_.y) * image_px_y;
  box.width = box_in_input.width * image_px_x;
  box.height = box_in_input.height * image_px_y;
  return box;
}

}  // namespace cpslam
