#pragma once

#include <span>
#include <vector>

namespace cpslam {

/// 1 for every angle difference (deg, any range) that lies in one of the three fullest 12-degree bins of
/// their histogram: a camera that turns about its axis turns all keypoints by the same angle. Bins with less
/// than a tenth of the fullest one's entries do not count.
[[nodiscard]] std::vector<bool> agrees_with_majority(std::span<const float> angle_differences_deg);

}  // namespace cpslam
