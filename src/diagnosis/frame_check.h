#pragma once

#include <opencv2/core/mat.hpp>

#include "diagnosis/finding.h"
#include "io/image_reader.h"

namespace cpslam::diagnosis {

/// A frame as the checks look at it.
struct ExaminedFrame {
  double time_s = 0.0;
  double depth_time_s = 0.0;
  cv::Mat grey;      ///< CV_8UC1
  cv::Mat readings;  ///< depth, CV_32FC1 in units of DepthMapFactor; 0: no reading
};

/// The images must be valid (RgbdImages::error is empty).
[[nodiscard]] ExaminedFrame make_examined_frame(const RgbdImages& images);

/// Looks at frames one after the other, in the order of time, and has its say at the end. Stretches of
/// consecutive frames may have gaps between them. All frames have the size of the first. One thread.
class FrameCheck {
 public:
  FrameCheck() = default;
  virtual ~FrameCheck() = default;
  FrameCheck(const FrameCheck&) = delete;
  FrameCheck& operator=(const FrameCheck&) = delete;

  virtual void add(const ExaminedFrame& frame) = 0;
  [[nodiscard]] virtual Findings findings() const = 0;
};

}  // namespace cpslam::diagnosis
