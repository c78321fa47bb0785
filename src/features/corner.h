#pragma once

namespace cpslam {

/// A FAST corner in a pyramid level (px of that level).
struct Corner {
  int x = 0;
  int y = 0;
  int response = 0;  ///< the highest FAST threshold at which the pixel is still a corner
};

}  // namespace cpslam
