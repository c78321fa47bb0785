#include "slam/recent_points.h"

#include <mutex>

namespace cpslam {
namespace {

constexpr double kMinFoundRatio = 0.25;
constexpr std::uint64_t kProbationKeyframes = 3;

enum class Verdict { kStays, kPassed, kFailed };

Verdict judge(const MapPoint& point, std::uint64_t current_sequence) {
  const std::uint64_t age = current_sequence - point.first_sequence;
  if (point.found < kMinFoundRatio * point.visible) return Verdict::kFailed;
  // One keyframe has had its turn to see the point again when the second after its own arrives.
  if (age >= 2 && point.observations.size() < 2) return Verdict::kFailed;
  return age >= kProbationKeyframes ? Verdict::kPassed : Verdict::kStays;
}

}  // namespace

void RecentPoints::cull(Map& map, KeyFrameId current) {
  const std::unique_lock lock(map.mutex());
  const KeyFrame* keyframe = map.keyframe(current);
  if (keyframe == nullptr) return;
  for (const MapPointId id : keyframe->points) {
    const MapPoint* point = map.point(id);
    if (point != nullptr && point->first_sequence == keyframe->sequence) points_.push_back(id);
  }
  std::erase_if(points_, [&](MapPointId id) {
    const MapPoint* point = map.point(id);
    if (point == nullptr) return true;
    // The camera is in another session now: nobody has a turn to see it any more, and it stays.
    if (map.session_of(point->reference) != keyframe->session) return true;
    const Verdict verdict = judge(*point, keyframe->sequence);
    if (verdict == Verdict::kFailed) map.erase_point(id);
    return verdict != Verdict::kStays;
  });
}

}  // namespace cpslam
