#include "openni/picture_conversion.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "cpslam/error.h"

namespace cpslam {
namespace {

struct Layout {
  int type = 0;        ///< of the matrix over OpenNI's memory
  int conversion = 0;  ///< cv::ColorConversionCodes; -1: a plain copy
};

Layout layout_of(openni::PixelFormat format) {
  switch (format) {
    case openni::PIXEL_FORMAT_RGB888:
      return {CV_8UC3, cv::COLOR_RGB2BGR};
    case openni::PIXEL_FORMAT_YUYV:
      return {CV_8UC2, cv::COLOR_YUV2BGR_YUY2};
    case openni::PIXEL_FORMAT_YUV422:
      return {CV_8UC2, cv::COLOR_YUV2BGR_UYVY};
    case openni::PIXEL_FORMAT_GRAY8:
      return {CV_8UC1, -1};
    case openni::PIXEL_FORMAT_DEPTH_1_MM:
    case openni::PIXEL_FORMAT_DEPTH_100_UM:
      return {CV_16UC1, -1};
    default:
      throw RunError("the camera's pixels have a format that cannot be read: " + std::to_string(format));
  }
}

}  // namespace

CameraPicture copy_picture(const openni::VideoFrameRef& frame, bool mirrored) {
  CameraPicture picture;
  picture.arrived = std::chrono::steady_clock::now();
  picture.time_us = frame.getTimestamp();
  const Layout layout = layout_of(frame.getVideoMode().getPixelFormat());
  const int width = frame.getWidth(), height = frame.getHeight(), stride = frame.getStrideInBytes();
  const auto row_bytes =
      static_cast<std::int64_t>(width) * static_cast<std::int64_t>(CV_ELEM_SIZE(layout.type));
  const bool whole = width > 0 && height > 0 && stride >= row_bytes &&
                     static_cast<std::int64_t>(stride) * (height - 1) + row_bytes <= frame.getDataSize();
  if (!whole) throw RunError("the camera delivers pictures that are not whole");
  // A matrix over memory that is only read.
  const cv::Mat raw(height, width, layout.type, const_cast<void*>(frame.getData()),
                    static_cast<std::size_t>(stride));
  if (layout.conversion >= 0) {
    cv::cvtColor(raw, picture.image, layout.conversion);
  } else {
    raw.copyTo(picture.image);
  }
  if (mirrored) cv::flip(picture.image, picture.image, 1);
  return picture;
}

}  // namespace cpslam
