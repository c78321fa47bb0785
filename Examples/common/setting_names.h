#pragma once

#include "cpslam/settings.h"

namespace cpslam::program {

/// As they are spelled on the command line and in stats.json.
[[nodiscard]] constexpr const char* name_of(DetectorKind kind) {
  switch (kind) {
    case DetectorKind::kBoxes:
      return "boxes";
    case DetectorKind::kYolo:
      return "yolo";
    case DetectorKind::kNone:
      break;
  }
  return "none";
}

[[nodiscard]] constexpr const char* name_of(BoxesPolicy policy) {
  return policy == BoxesPolicy::kWait ? "wait" : "latest";
}

[[nodiscard]] constexpr const char* name_of(PeopleFilter filter) {
  switch (filter) {
    case PeopleFilter::kPaper:
      return "paper";
    case PeopleFilter::kBoxes:
      return "boxes";
    case PeopleFilter::kSdf:
      break;
  }
  return "sdf";
}

/// The policy in force.
[[nodiscard]] inline BoxesPolicy boxes_policy(const Settings& settings) {
  return settings.detector.policy.value_or(settings.realtime ? BoxesPolicy::kLatest : BoxesPolicy::kWait);
}

}  // namespace cpslam::program
