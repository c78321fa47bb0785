#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>

#include "diagnosis/frame_check.h"

namespace cpslam::diagnosis {

/// Boxes at different depths before a wall, each of one shade; the camera looks at a part of them that moves.
class PannedScene {
 public:
  static constexpr int kWidth = 320, kHeight = 240;

  explicit PannedScene(std::uint64_t seed = 1);

  /// Where the camera looks at a time, px of the scene.
  using Pan = std::function<cv::Point2d(double time_s)>;
  [[nodiscard]] cv::Mat grey(cv::Point2d at) const;      ///< CV_8UC1
  [[nodiscard]] cv::Mat readings(cv::Point2d at) const;  ///< CV_32FC1

  /// A frame whose depth shows what was to be seen delay_s before its stamp.
  [[nodiscard]] ExaminedFrame frame(double time_s, const Pan& pan, double delay_s = 0.0) const;

 private:
  cv::Mat grey_, readings_;
};

/// To and fro like a hand-held camera, some 100 px/s.
[[nodiscard]] cv::Point2d handheld(double time_s);

}  // namespace cpslam::diagnosis
