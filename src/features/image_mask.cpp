#include "features/image_mask.h"

#include <string>

#include "cpslam/error.h"
#include "features/image_check.h"

namespace cpslam {
ImageMask::ImageMask(const cv::Mat& mask, cv::Size image_size) {
  if (mask.empty()) return;
  const cv::Size coarse(image_size.width / kMaskCellPx, image_size.height / kMaskCellPx);
  if (mask.type() != CV_8UC1)
    throw InputError("a mask must have 8 bits in one channel, not OpenCV type " +
                     std::to_string(mask.type()));
  if (mask.size() != image_size && mask.size() != coarse) {
    throw InputError("the mask is " + size_text(mask.size()) + ": for images of " + size_text(image_size) +
                     " it must be of the same size or " + size_text(coarse));
  }
  if (cv::countNonZero(mask) == 0) return;
  mask_ = mask;
  cell_shift_ = mask.size() == image_size ? 0 : kMaskCellShift;
}

}  // namespace cpslam
