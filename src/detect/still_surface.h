#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "detect/grid_camera.h"
#include "geometry/se3.h"

namespace cpslam {

/// What stands still against the room, as far as depths tell, per cell of the depth grid.
struct StillSurface {
  cv::Mat1f
      depth_m;    ///< of the surface, a running mean in which somebody who walks to the camera falls behind
  cv::Mat1b age;  ///< frames for which it has been found where the camera's motion puts it; up to 250
  /// The same, but begun anew while it belongs to somebody: a torso that passes by looks still.
  cv::Mat1b free_age;
  cv::Mat1b changed;  ///< non-zero where it came into view, since something arrived or went away there

  /// Nothing known yet.
  static StillSurface begin(const cv::Mat1f& depth_m);
  /// The surface in the next frame. Where something has come before what was expected its age begins at 0;
  /// where nothing was known, or what was uncovered lies behind, at kUnknownAge.
  [[nodiscard]] StillSurface carry(const GridCamera& camera, const cv::Mat1f& next_depth_m,
                                   const SE3& next_from_this) const;

  /// What belongs to somebody (people: paint_people, of the same frame) is not background.
  void claim(const cv::Mat1b& people);

  static constexpr std::uint8_t kUnknownAge = 8;  ///< what is younger has arrived
  static constexpr std::uint8_t kStillAge = 12;   ///< from this age on it counts as still
  static constexpr std::uint8_t kRecentAge = 20;  ///< up to this age it may belong to what has just arrived

 private:
  /// As it would look in the next frame if nothing but the camera moved.
  [[nodiscard]] StillSurface move(const GridCamera& camera, const SE3& next_from_this) const;
};

/// How far a reading of a still surface may be from what another frame predicts (m).
[[nodiscard]] float still_tolerance_m(float depth_m);

}  // namespace cpslam
