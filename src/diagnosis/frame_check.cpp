#include "diagnosis/frame_check.h"

#include <opencv2/core.hpp>

#include "slam/frame_input.h"

namespace cpslam::diagnosis {

ExaminedFrame make_examined_frame(const RgbdImages& images) {
  ExaminedFrame frame;
  frame.time_s = images.time_s;
  frame.depth_time_s = images.depth_time_s;
  frame.grey = to_grey(images.colour);
  images.depth.convertTo(frame.readings, CV_32F);
  constexpr double kLargest = 1e9;                                                  // NaN compares false
  const cv::Mat is_reading = (frame.readings > 0.0) & (frame.readings < kLargest);  // also when infinite
  frame.readings.setTo(0.0, ~is_reading);
  return frame;
}

}  // namespace cpslam::diagnosis
