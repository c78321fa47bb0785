#pragma once

#include <opencv2/core/mat.hpp>

namespace cpslam::viewer {

/// Tints for a person mask (FrameView::person_mask): CV_8UC4 in R,G,B,A, see-through where nobody is and
/// stronger on the outlines. Empty for an empty mask or one without people.
[[nodiscard]] cv::Mat mask_overlay(const cv::Mat& person_mask);

}  // namespace cpslam::viewer
