#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "cpslam/types.h"
#include "detect/still_surface.h"

namespace cpslam {

/// What is known of a frame before its boxes are looked at. Cells of the depth grid.
struct SceneEvidence {
  const cv::Mat1f& depth_m;
  const cv::Mat1b& people;  ///< paint_people of those carried into the frame
  const StillSurface& still;
};

/// A person's box, and what is known of him if he was carried into the frame.
struct KnownBox {
  PersonBox box;
  std::uint8_t number = 0;  ///< 0: nobody is expected here
  bool moves = false;       ///< he walks
};

}  // namespace cpslam
