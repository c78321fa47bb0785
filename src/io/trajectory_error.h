#pragma once

#include <cstddef>
#include <optional>

#include "cpslam/types.h"
#include "geometry/se3.h"

namespace cpslam {

/// Absolute trajectory error, metres.
struct TrajectoryError {
  std::size_t pairs = 0;
  double rmse_m = 0.0;
  double mean_m = 0.0;
  double median_m = 0.0;
  double max_m = 0.0;
};

/// ATE of the TUM benchmark (Sturm et al. 2012): stamps associated one-to-one within max_difference_s,
/// closest first; rigid alignment without scale. Fewer than three pairs give pairs as found and zeros.
[[nodiscard]] TrajectoryError absolute_trajectory_error(const Trajectory& truth, const Trajectory& estimate,
                                                        double max_difference_s = 0.02);

/// The rigid transform estimate_from_truth of that alignment; nothing for fewer than three pairs.
[[nodiscard]] std::optional<SE3> align_to_estimate(const Trajectory& truth, const Trajectory& estimate,
                                                   double max_difference_s = 0.02);

}  // namespace cpslam
