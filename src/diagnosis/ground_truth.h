#pragma once

#include <span>

#include "cpslam/types.h"
#include "diagnosis/finding.h"

namespace cpslam::diagnosis {

/// Whether a ground truth can judge a sequence: how much of it is covered, rate, order, jumps.
[[nodiscard]] Findings check_ground_truth(const Trajectory& truth, std::span<const double> colour_s);

}  // namespace cpslam::diagnosis
