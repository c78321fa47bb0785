#include "slam/keyframe_decision.h"

namespace cpslam {

bool wants_keyframe(const KeyFrameEvidence& e) {
  constexpr int kMinInliers = 15;
  constexpr int kFewClose = 100;
  constexpr int kManyUntracked = 70;
  constexpr double kWeakRatio = 0.8;
  constexpr double kUrgentRatio = 0.25;
  if (e.inliers <= kMinInliers || e.mapper_load == MapperLoad::kFull) return false;
  const bool close_is_missing = e.close_tracked < kFewClose && e.close_untracked > kManyUntracked;
  const bool weak = e.inliers < kWeakRatio * e.best_inliers;
  if (!weak && !close_is_missing) return false;
  if (e.mapper_load == MapperLoad::kIdle) return true;
  return close_is_missing || e.inliers < kUrgentRatio * e.best_inliers;
}

}  // namespace cpslam
