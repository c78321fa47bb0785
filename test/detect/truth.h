#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "cpslam/types.h"

namespace cpslam {

/// How well a filter does on a simulated sequence, against the simulator's person mask.
struct FilterTruth {
  std::size_t on_people = 0, on_people_removed = 0;  ///< keypoints on people: the mask without its outer 2 px
  std::size_t in_boxes = 0, in_boxes_kept = 0;       ///< static keypoints inside boxes, 3 px from any person
  std::size_t rim = 0, rim_removed = 0;              ///< the band between
  std::size_t elsewhere = 0, elsewhere_kept = 0;     ///< static keypoints outside all boxes
  double mask_iou_sum = 0.0;                         ///< over frames that show people
  std::size_t mask_frames = 0;

  FilterTruth& operator+=(const FilterTruth& other);
  [[nodiscard]] double removed_share() const { return share(on_people_removed, on_people); }
  [[nodiscard]] double kept_share() const { return share(in_boxes_kept, in_boxes); }
  [[nodiscard]] double rim_removed_share() const { return share(rim_removed, rim); }
  [[nodiscard]] double elsewhere_kept_share() const { return share(elsewhere_kept, elsewhere); }
  [[nodiscard]] double mask_iou() const {
    return mask_frames == 0 ? 1.0 : mask_iou_sum / double(mask_frames);
  }
  static double share(std::size_t part, std::size_t all) {
    return all == 0 ? 1.0 : double(part) / double(all);
  }
};

struct TruthOptions {
  std::string preset = "walking_xyz";
  std::uint64_t seed = 1;
  int n_people = -1;  ///< -1: the preset's
  int n_frames = 100;
  double box_jitter = 0.0;         ///< standard deviation of a box's sides, in its size
  double box_missing = 0.0;        ///< share of the boxes
  double detection_rate_hz = 0.0;  ///< 0: every frame
  double detection_delay_s = 0.0;
  bool verbose = false;
};

/// Runs the person tracks and the keypoint filter on a simulated sequence with sensor noise.
[[nodiscard]] FilterTruth measure_filter(const TruthOptions& options);

}  // namespace cpslam
