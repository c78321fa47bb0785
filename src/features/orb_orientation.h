#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "features/corner.h"
#include "features/simd.h"

namespace cpslam {

/// First moments of the grey values in a disc of radius 15 px around a pixel.
struct PatchMoments {
  int m10 = 0;  ///< sum of x * grey, x to the right
  int m01 = 0;  ///< sum of y * grey, y down
};

/// The disc is the digital one of ORB: column counts rounded and symmetric in x and y. Reads up to 16 px
/// around.
[[nodiscard]] PatchMoments patch_moments(const cv::Mat& level, int x, int y, Simd simd);

/// Angles (degrees, [0, 360), from x towards y) of the intensity centroids seen from the corners (Rosin 1999;
/// Rublee et al. 2011), by cv::fastAtan2 as in OpenCV (within 0.3 degrees). Corners at least kOrbBorderPx
/// from the border.
void orient_corners(const cv::Mat& level, const std::vector<Corner>& corners, Simd simd,
                    std::vector<float>& angles_deg);

}  // namespace cpslam
