#pragma once

#include <span>
#include <vector>

#include "map/map.h"

namespace cpslam {

/// A place that looks alike once may do so by chance: tells those candidates that several keyframes in a row
/// agreed on, each within a covisible neighbourhood of the one before (Mur-Artal et al. 2015, VII-A).
class LoopConsistency {
 public:
  /// needed: keyframes in a row that must agree, the present one among them.
  explicit LoopConsistency(int needed) : needed_(needed) {}

  /// The candidates of the next keyframe; returns those that are consistent, in the same order. Takes a
  /// shared lock of the map.
  [[nodiscard]] std::vector<KeyFrameId> update(const Map& map, std::span<const KeyFrameId> candidates);
  void reset() { groups_.clear(); }

 private:
  struct Group {
    std::vector<KeyFrameId> members;  // sorted: the candidate and its covisible keyframes
    int met = 1;                      // in so many keyframes in a row
  };

  [[nodiscard]] int times_met(const std::vector<KeyFrameId>& members) const;

  int needed_;
  std::vector<Group> groups_;  // of the last keyframe
};

}  // namespace cpslam
