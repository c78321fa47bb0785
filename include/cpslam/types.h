#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cpslam {

/// A rigid pose: x_target = rotation * x_source + translation. The name of a Pose says target_from_source.
struct Pose {
  std::array<double, 4> rotation_xyzw{0.0, 0.0, 0.0, 1.0};  ///< unit quaternion
  std::array<double, 3> translation_m{0.0, 0.0, 0.0};
};

using WorldPoint = std::array<float, 3>;  ///< metres, in the world of the trajectory

/// A person, or another thing that moves by itself, in an image: pixels of the image as the camera took it,
/// top-left corner; may reach over the image's border.
struct PersonBox {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
  double confidence = 1.0;  ///< [0, 1]
};

/// Where tracking was lost in a new place another map is begun, in a world of its own, until a loop connects
/// the two. Maps are numbered from 1 in the order they were begun; a number is not used again.
struct StampedPose {
  double time_s = 0.0;
  Pose world_from_camera;
  int map = 1;  ///< in whose world the pose is
};

/// May be of several maps: split_by_map() (cpslam/trajectory.h).
using Trajectory = std::vector<StampedPose>;

enum class TrackingState {
  kNotInitialized,  ///< no frame with enough depth yet
  kTracked,         ///< the pose was optimised on enough inliers (TrackingSettings::min_inliers)
  kWeak,            ///< likewise, but on hardly enough, or they hardly determine it: be careful
  kPredicted,       ///< the pose is only carried on by the motion model; not written to the trajectory
  kLost,            ///< no pose
};

/// The pose was found in the image: kTracked or kWeak.
[[nodiscard]] constexpr bool is_tracked(TrackingState state) {
  return state == TrackingState::kTracked || state == TrackingState::kWeak;
}

/// Of the six numbers d = (translation m, rotation vector rad) by which a pose is off, in the camera's own
/// frame (x right, y down, z forward): true world_from_camera = world_from_camera * exp(d). Row by row.
using PoseCovariance = std::array<double, 36>;

/// What track() found out about one frame.
struct TrackResult {
  TrackingState state = TrackingState::kNotInitialized;
  double time_s = 0.0;
  Pose world_from_camera;  ///< valid when kTracked, kWeak or kPredicted
  int map = 0;             ///< in whose world the pose is, at this time (see StampedPose); 0 without a pose
  /// When tracked: from the keypoints' and depths' noise against the map as it stands; how far the map itself
  /// is off is not in it. Zero for the frame that starts the map: it is where the world begins. Empty when
  /// bridged.
  std::optional<PoseCovariance> covariance;
  int n_keypoints = 0;
  int n_inliers = 0;      ///< map points that agree with the pose
  bool keyframe = false;  ///< the frame became a keyframe
  /// When only localising: the map shows nothing here, the pose is carried on from the frames before and
  /// drifts: kWeak, without a covariance.
  bool bridged = false;
};

/// Milliseconds a stage took, over all its calls.
struct StageTimes {
  std::string stage;
  std::size_t count = 0;
  double p50_ms = 0.0;
  double p95_ms = 0.0;
  double max_ms = 0.0;
  double total_ms = 0.0;
};

/// What the person detector and the people filter did.
struct PeopleStatistics {
  std::size_t detections = 0;         ///< images the detector has finished, or the caller brought boxes for
  std::size_t detector_failures = 0;  ///< of them: threw, or were given up
  /// A detection was given up and has not come back: System's destructor would wait for it, however long.
  bool detector_stuck = false;
  std::size_t boxes = 0;                 ///< over all detections
  std::size_t keypoints = 0;             ///< over all frames, before the filter
  std::size_t removed_keypoints = 0;     ///< of them: on people
  std::size_t reinstated_keypoints = 0;  ///< on people who do not move: not removed
  std::size_t extended_frames = 0;       ///< frames that got a second extraction outside the people
  double mean_boxes_age_s = 0.0;  ///< of the newest boxes, over the frames that had any; in frame stamps
  double max_boxes_age_s = 0.0;
};

/// A place that was recognised, and the map bent so that it is one.
struct LoopEvent {
  double time_s = 0.0;          ///< of the keyframe that recognised it
  double matched_time_s = 0.0;  ///< of the keyframe that had been there before
  int inliers = 0;              ///< points of the earlier visit that the later one sees again
  double error_m = 0.0;         ///< how far the map had the one off the other; 0 between two maps
  double error_deg = 0.0;
  int joined_map =
      0;  ///< number of the map that this loop made part of the older one; 0: it was within a map
};

/// A map at present.
struct MapCounts {
  int map = 1;                ///< its number
  std::size_t frames = 0;     ///< tracked in it in this run
  std::size_t keyframes = 0;  ///< alive
};

/// What loop closing did.
struct LoopStatistics {
  std::vector<LoopEvent> events;                     ///< by the order in which they were closed
  std::size_t full_bundle_adjustments = 0;           ///< of the whole map, after a loop
  std::size_t full_bundle_adjustments_given_up = 0;  ///< for the next loop, or at the end
};

/// A map that was loaded, and how the camera was found in it.
struct LoadedMapStatistics {
  std::size_t maps = 0;                 ///< that nothing connected yet, in the file: the maps 1 to so many
  std::size_t keyframes = 0;            ///< the map came with
  std::size_t points = 0;               ///< the map came with
  bool other_vocabulary = false;        ///< it was made with other words: they were found anew
  std::optional<double> found_time_s;   ///< of the first frame that was recognised in it
  std::size_t frames_before_found = 0;  ///< frames without a pose until then
};

/// What is left of the map, or maps, that System::reset() dropped, each in its world, as they were then.
struct DroppedMap {
  Trajectory trajectory;           ///< of its tracked frames
  Trajectory keyframe_trajectory;  ///< of its keyframes that were alive
};

struct Statistics {
  std::size_t frames = 0;
  std::size_t tracked = 0;
  std::size_t weak = 0;     ///< of them: TrackingState::kWeak
  std::size_t bridged = 0;  ///< of them: TrackResult::bridged
  std::size_t predicted = 0;
  std::size_t lost = 0;
  std::size_t not_initialized = 0;
  std::size_t keyframes = 0;          ///< alive
  std::size_t keyframes_created = 0;  ///< in all maps of the run, as all counts of work
  std::size_t map_points = 0;         ///< alive
  std::size_t map_points_created = 0;
  std::size_t dropped_maps = 0;  ///< by System::reset()
  std::size_t local_bundle_adjustments = 0;
  PeopleStatistics people;
  LoopStatistics loops;
  std::optional<LoadedMapStatistics> loaded_map;
  std::vector<MapCounts> maps;     ///< those with most frames first
  std::size_t maps_started = 0;    ///< in this run; how many a loop joined to others, loops.events tells
  std::vector<StageTimes> stages;  ///< "detect" is the detector's
};

}  // namespace cpslam
