#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "cpslam/settings.h"
#include "cpslam/system.h"
#include "cpslam/types.h"
#include "sim/simulation.h"

namespace cpslam::e2e {

/// A simulated frame as a camera would hand it over.
struct ClipFrame {
  cv::Mat colour, depth;
  double time_s = 0.0;
  Pose world_from_camera;  ///< truth, in the simulator's world
};

/// Frames in memory with the settings to run on them.
struct Clip {
  Settings settings;  ///< sequential
  std::vector<ClipFrame> frames;

  [[nodiscard]] Trajectory truth() const;
};

[[nodiscard]] Clip render_clip(const sim::SimulationOptions& options);

/// Feeds all frames in order.
[[nodiscard]] std::vector<TrackResult> track_all(System& system, const Clip& clip);

/// Distance (m) between where a result puts the camera and where it was at that frame. SLAM's world starts at
/// the camera's pose in the first frame.
[[nodiscard]] double position_error_m(const TrackResult& result, const ClipFrame& frame,
                                      const ClipFrame& first);

/// Resident memory of this process now, MB.
[[nodiscard]] double resident_memory_mb();

}  // namespace cpslam::e2e
