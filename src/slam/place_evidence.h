#pragma once

#include <cstddef>

#include "slam/frame.h"
#include "slam/local_map.h"
#include "slam/rig.h"

namespace cpslam {

/// What speaks for and against a frame being where a few dozen matches put it. Another desk of the same kind
/// agrees with many points of this one; but then most of the other points are not found, the frame's other
/// keypoints match none, and it looks through where the map says that something is.
struct PlaceEvidence {
  /// Of the keypoints where the map lets expect a point: matched to one. Low where the map is dense.
  double matched_share = 0.0;
  /// Of the points that are expected where the frame has keypoints: found. Low where one spot has many
  /// points.
  double found_share = 0.0;
  /// Of the points that are expected and beside which a depth was read: nothing there, only what is farther.
  /// A nearer depth says nothing: somebody may stand there.
  double seen_through_share = 0.0;
  std::ptrdiff_t n_expected = 0;  ///< points that found_share is a share of

  /// Whether the pose may be believed without knowing where the camera was before: no share alone tells all
  /// right places from wrong ones, their balance does.
  [[nodiscard]] bool is_convincing() const;
};

/// Compares the frame, placed and matched, with the local map. No matches and no map give zeros.
[[nodiscard]] PlaceEvidence place_evidence(const Rig& rig, const LocalMap& local_map, const Frame& frame);

}  // namespace cpslam
