#pragma once

namespace cpslam {

/// How much the mapper has to do.
enum class MapperLoad {
  kIdle,
  kBusy,
  kFull,  ///< it takes no more keyframes
};

/// What the decision for a keyframe rests on.
struct KeyFrameEvidence {
  int inliers = 0;          ///< map points the frame tracks
  int best_inliers = 0;     ///< most that a frame since the last keyframe tracked
  int close_tracked = 0;    ///< close keypoints that have a map point
  int close_untracked = 0;  ///< close keypoints that could become one
  MapperLoad mapper_load = MapperLoad::kIdle;
};

/// Whether the frame should become a keyframe: tracking has grown weak against the reference keyframe, or
/// much of what is close is not in the map yet (criteria of Mur-Artal and Tardos 2017, III-E). A busy mapper
/// gets only keyframes that are urgent, a full one none.
[[nodiscard]] bool wants_keyframe(const KeyFrameEvidence& evidence);

}  // namespace cpslam
