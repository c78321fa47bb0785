#include "slam/loop_consistency.h"

#include <algorithm>
#include <shared_mutex>

namespace cpslam {
namespace {

std::vector<KeyFrameId> neighbourhood(const Map& map, KeyFrameId id) {
  std::vector<KeyFrameId> members{id};
  if (const KeyFrame* keyframe = map.keyframe(id)) {
    for (const Covisible& edge : keyframe->covisible) members.push_back(edge.keyframe);
  }
  std::sort(members.begin(), members.end());
  return members;
}

/// Both sorted.
bool overlap(const std::vector<KeyFrameId>& a, const std::vector<KeyFrameId>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&b](KeyFrameId id) { return std::binary_search(b.begin(), b.end(), id); });
}

}  // namespace

std::vector<KeyFrameId> LoopConsistency::update(const Map& map, std::span<const KeyFrameId> candidates) {
  const std::shared_lock lock(map.mutex());
  std::vector<Group> groups;
  std::vector<KeyFrameId> consistent;
  for (const KeyFrameId candidate : candidates) {
    Group group{neighbourhood(map, candidate), 1};
    group.met = times_met(group.members) + 1;
    if (group.met >= needed_) consistent.push_back(candidate);
    groups.push_back(std::move(group));
  }
  groups_ = std::move(groups);
  return consistent;
}

int LoopConsistency::times_met(const std::vector<KeyFrameId>& members) const {
  int met = 0;
  for (const Group& group : groups_) {
    if (group.met > met && overlap(group.members, members)) met = group.met;
  }
  return met;
}

}  // namespace cpslam
