#pragma once

#include <opencv2/core.hpp>

namespace cpslam {

/// Side of a depth grid's cell in px of the depth image.
inline constexpr int kDepthCellPx = 4;

/// A depth image (CV_16UC1 or CV_32FC1, metres_per_unit metres a step; 0, negative and not finite are no
/// readings) reduced to one depth (m) per cell of 4 x 4 px, 0 where none of the four readings taken in a cell
/// is valid. Where a cell holds two surfaces one of them is taken, never a depth between. Cells that reach
/// over the image's right or lower border are left out. Thread-safe.
[[nodiscard]] cv::Mat1f reduce_depth(const cv::Mat& raw, double metres_per_unit);

}  // namespace cpslam
