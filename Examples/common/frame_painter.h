#pragma once

#include <opencv2/core/mat.hpp>

#include "cpslam/rgbd_frame.h"

namespace cpslam::program {

/// The image (CV_8UC3 B,G,R or CV_8UC1) with what was seen in it: people tinted, boxes with their confidence,
/// keypoints green (bright: on the map) or red (left out), counts and the boxes' age in a line at the top.
/// CV_8UC3.
[[nodiscard]] cv::Mat paint(const cv::Mat& image, const FrameView& view);

}  // namespace cpslam::program
