#pragma once

#include <opencv2/core.hpp>

namespace cpslam {

/// What is known of a frame before its boxes are looked at. Cells of the depth grid.
struct SceneEvidence {
  const cv::Mat1f& depth_m;
  const cv::Mat1b& people;     ///< paint_people of those carried into the frame
  const cv::Mat1b& still_age;  ///< StillSurface::age
};

}  // namespace cpslam
