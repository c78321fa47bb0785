#pragma once

#include "cpslam/types.h"

namespace cpslam {

/// Intersection over union of two boxes, 0 where they do not meet; a side below zero counts as zero.
[[nodiscard]] float box_overlap(const PersonBox& a, const PersonBox& b);

}  // namespace cpslam
