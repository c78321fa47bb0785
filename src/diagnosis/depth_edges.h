#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace cpslam::diagnosis {

/// Where a near surface ends before a far one.
struct DepthEdges {
  /// Pixels whose right (across) or lower (down) neighbour is on the other side of the edge. Where readings
  /// are missing between the two surfaces, the near one's border counts: it is what hides the other.
  std::vector<cv::Point> across, down;
};

/// readings: CV_32FC1, 0: none.
[[nodiscard]] DepthEdges find_depth_edges(const cv::Mat& readings);

/// Strength of a picture's edges between a pixel and its right (across) or lower neighbour, CV_32FC1, mean 1
/// and at most 4.
struct ColourEdges {
  cv::Mat across, down;
};

/// grey: CV_8UC1.
[[nodiscard]] ColourEdges find_colour_edges(const cv::Mat& grey);

}  // namespace cpslam::diagnosis
