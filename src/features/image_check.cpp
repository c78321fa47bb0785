#include "features/image_check.h"

#include "cpslam/error.h"

namespace cpslam {
std::string size_text(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

void check_images(const cv::Mat& colour, const cv::Mat& depth, cv::Size expected) {
  if (colour.empty()) throw InputError("the colour image is empty");
  if (depth.empty()) throw InputError("the depth image is empty");
  if (colour.type() != CV_8UC3 && colour.type() != CV_8UC1) {
    throw InputError("the colour image must have 8 bits in one or three channels");
  }
  if (depth.type() != CV_16UC1 && depth.type() != CV_32FC1) {
    throw InputError("the depth image must have 16-bit integers or 32-bit floats in one channel");
  }
  if (colour.size() != depth.size()) {
    throw InputError("the colour image is " + size_text(colour.size()) + " and the depth image " +
                     size_text(depth.size()) + ": depth must be registered to colour");
  }
  if (colour.size() != expected) {
    throw InputError("the images are " + size_text(colour.size()) +
                     ", but the settings' Camera.width and Camera.height say " + size_text(expected));
  }
}

}  // namespace cpslam
