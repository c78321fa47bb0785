#include "slam/local_map.h"

#include <algorithm>
#include <map>
#include <shared_mutex>

namespace cpslam {
namespace {

constexpr std::size_t kMaxKeyframes = 60;
constexpr std::size_t kNeighboursEach = 10;

}  // namespace

void LocalMap::update(const Map& map, const Frame& frame) {
  const std::shared_lock lock(map.mutex());
  std::map<KeyFrameId, int> votes;
  for (const PointMatch& match : frame.matches) {
    if (match.kind != PointMatch::Kind::kMapPoint) continue;
    if (const MapPoint* point = map.point(match.id)) {
      for (const Observation& seen : point->observations) ++votes[seen.keyframe];
    }
  }
  if (votes.empty()) return;
  std::vector<std::pair<int, KeyFrameId>> order;
  order.reserve(votes.size());
  for (const auto& [id, n] : votes) order.emplace_back(-n, id);
  std::sort(order.begin(), order.end());
  const KeyFrameId reference = order.front().second;
  if (reference == reference_ && map.version() == map_version_) return;
  reference_ = reference;
  std::vector<KeyFrameId> seeds;
  seeds.reserve(order.size());
  for (const auto& [n, id] : order) seeds.push_back(id);
  copy(map, seeds);
}

void LocalMap::centre_on(const Map& map, KeyFrameId keyframe) {
  const std::shared_lock lock(map.mutex());
  reference_ = keyframe;
  copy(map, {keyframe});
}

void LocalMap::copy(const Map& map, const std::vector<KeyFrameId>& seeds) {
  std::vector<KeyFrameId> keyframes(
      seeds.begin(), seeds.begin() + static_cast<std::ptrdiff_t>(std::min(seeds.size(), kMaxKeyframes)));
  const auto add = [&](KeyFrameId id) {
    if (keyframes.size() < kMaxKeyframes &&
        std::find(keyframes.begin(), keyframes.end(), id) == keyframes.end()) {
      keyframes.push_back(id);
    }
  };
  for (std::size_t i = 0, n = keyframes.size(); i < n; ++i) {
    for (const KeyFrameId id : map.best_covisible(keyframes[i], kNeighboursEach)) add(id);
  }
  points_.clear();
  std::fill(gathered_.begin(), gathered_.end(), std::uint8_t{0});
  for (const KeyFrameId id : keyframes) {
    const KeyFrame* keyframe = map.keyframe(id);
    if (keyframe == nullptr) continue;
    for (const MapPointId point_id : keyframe->points) {
      if (!point_id.valid()) continue;
      if (point_id.index >= gathered_.size()) gathered_.resize(point_id.index + std::size_t{1}, 0);
      if (gathered_[point_id.index] != 0) continue;
      gathered_[point_id.index] = 1;
      if (const MapPoint* point = map.point(point_id)) points_.emplace_back(point_id, *point);
    }
  }
  if (const KeyFrame* reference = map.keyframe(reference_)) reference_from_world_ = reference->cam_from_world;
  map_version_ = map.version();
}

}  // namespace cpslam
