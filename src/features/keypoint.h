#pragma once

namespace cpslam {

/// A keypoint freed of lens distortion.
struct Keypoint {
  float x = 0.0F;  ///< undistorted px of level 0
  float y = 0.0F;
  float angle_deg = 0.0F;  ///< [0, 360), clockwise in the image (y down)
  float response = 0.0F;   ///< FAST score
  int octave = 0;          ///< pyramid level, 0 = full resolution
};

}  // namespace cpslam
