#pragma once

#include <span>
#include <string>
#include <vector>

#include "cpslam/dense_map.h"
#include "dense/dense_views.h"

namespace cpslam {

/// Whether the library was built with OctoMap.
[[nodiscard]] bool has_octomap();

/// Writes an OctoMap's .bt: occupied where points are, free where the views looked through. Throws InputError
/// without OctoMap, RunError when writing fails.
void write_octomap(const std::string& path, double resolution_m, std::span<const CloudPoint> points,
                   const DenseCamera& camera, const std::vector<PlacedView>& views);

}  // namespace cpslam
