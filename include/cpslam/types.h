#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cpslam {

/// A rigid pose: x_target = rotation * x_source + translation. The name of a Pose says target_from_source.
struct Pose {
  std::array<double, 4> rotation_xyzw{0.0, 0.0, 0.0, 1.0};  ///< unit quaternion
  std::array<double, 3> translation_m{0.0, 0.0, 0.0};
};

struct StampedPose {
  double time_s = 0.0;
  Pose world_from_camera;
};

using Trajectory = std::vector<StampedPose>;

enum class TrackingState {
  kNotInitialized,  ///< no frame with enough depth yet
  kTracked,         ///< the pose was optimised on enough inliers (TrackingSettings::min_inliers)
  kPredicted,       ///< the pose is only carried on by the motion model; not written to the trajectory
  kLost,            ///< no pose
};

/// What track() found out about one frame.
struct TrackResult {
  TrackingState state = TrackingState::kNotInitialized;
  double time_s = 0.0;
  Pose world_from_camera;  ///< valid when kTracked or kPredicted
  int n_keypoints = 0;
  int n_inliers = 0;      ///< map points that agree with the pose
  bool keyframe = false;  ///< the frame became a keyframe
};

/// Milliseconds a stage took, over all its calls.
struct StageTimes {
  std::string stage;
  std::size_t count = 0;
  double p50_ms = 0.0;
  double p95_ms = 0.0;
  double max_ms = 0.0;
};

struct Statistics {
  std::size_t frames = 0;
  std::size_t tracked = 0;
  std::size_t predicted = 0;
  std::size_t lost = 0;
  std::size_t not_initialized = 0;
  std::size_t keyframes = 0;  ///< alive
  std::size_t keyframes_created = 0;
  std::size_t map_points = 0;  ///< alive
  std::size_t map_points_created = 0;
  std::size_t local_bundle_adjustments = 0;
  std::vector<StageTimes> stages;
};

}  // namespace cpslam
