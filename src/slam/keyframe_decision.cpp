#include "slam/keyframe_decision.h"

namespace cpslam {

bool wants_keyframe(const KeyFrameEvidence& e) {
  constexpr int kMinInliers = 15;
  constexpr int kFewClose = 100;
  constexpr int kManyUntracked = 70;
  constexpr double kWeakRatio = 0.75;
  // With a single keyframe nothing is triangulated yet and little is established: wait for more motion.
  constexpr double kWeakRatioAtStart = 0.4;
  constexpr double kUrgentRatio = 0.25;
  if (e.inliers <= kMinInliers || e.mapper_load == MapperLoad::kFull) return false;
  const bool close_is_missing = e.close_tracked < kFewClose && e.close_untracked > kManyUntracked;
  const double ratio = e.only_one_keyframe ? kWeakRatioAtStart : kWeakRatio;
  const bool weak = e.inliers < ratio * e.reference_points;
  if (!weak && !close_is_missing) return false;
  if (e.mapper_load == MapperLoad::kIdle) return true;
  return close_is_missing || e.inliers < kUrgentRatio * e.reference_points;
}

}  // namespace cpslam
