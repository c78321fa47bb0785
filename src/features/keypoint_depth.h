#pragma once

#include <opencv2/core.hpp>

namespace cpslam {

/// Depth (m, along z) and its standard deviation (m); both 0 where there is none.
struct DepthReading {
  float depth_m = 0.0F;
  float sigma_m = 0.0F;
};

/// Depth of the keypoint at pixel (x, y) of a raw depth image (CV_16UC1 or CV_32FC1, metres_per_unit metres a
/// step; 0, negative and not finite are no readings), judged by its 5 x 5 neighbourhood:
///  - One surface (the spread is what a slanted surface or noise explains): the centre's reading.
///  - A depth edge: a corner on an occluding edge belongs to the near surface, so the median of the near
///  readings,
///    if at least a fifth of all readings are near. Fewer are outliers, and the centre's reading stays.
///  - No reading at the centre: the median of the surface chosen that way, if it fills 30 % of the
///  neighbourhood.
/// sigma_m combines the sensor's noise (structured_light_sigma_m) with half a pixel of localisation error on
/// the local slope; wherever the depth is not simply the centre's on one surface, it is doubled. Thread-safe.
[[nodiscard]] DepthReading read_keypoint_depth(const cv::Mat& raw_depth, double metres_per_unit, int x,
                                               int y);

}  // namespace cpslam
