#pragma once

#include <span>
#include <string>

#include "cpslam/dense_map.h"

namespace cpslam {

/// Writes points as a binary little-endian PLY: x y z nx ny nz (float), red green blue (uchar). Throws
/// RunError when that fails; an old file is there until then.
void write_ply(const std::string& path, std::span<const CloudPoint> points);

}  // namespace cpslam
