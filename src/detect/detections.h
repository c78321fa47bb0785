#pragma once

#include <cstdint>
#include <vector>

#include "cpslam/types.h"

namespace cpslam {

/// What a detector found in one colour image.
struct Detections {
  std::uint64_t frame = 0;  ///< index of the frame the image belongs to
  double time_s = 0.0;      ///< the image's stamp
  std::vector<PersonBox> boxes;
};

}  // namespace cpslam
