#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "detect/grid_camera.h"
#include "detect/person_track.h"
#include "detect/still_surface.h"
#include "geometry/se3.h"

namespace cpslam {

/// From one frame to the next.
struct FrameStep {
  const cv::Mat1f& depth_m;   ///< the depth grid
  const StillSurface& still;  ///< in this frame
  SE3 this_from_previous;     ///< the camera's motion
  double time_s = 0.0;        ///< of this frame
  double dt_s = 0.0;
};

/// Carries people from one frame into the next: each one's surface is moved by the camera's motion and his
/// own velocity, found again where the new depths agree, and grown over depth-connected cells near by that
/// the static surfaces of the previous frame do not explain. A person who cannot be found again keeps the
/// shape he had, moved on, for the next frame.
void carry_people(const GridCamera& camera, const FrameStep& step, std::vector<PersonTrack>& tracks);

}  // namespace cpslam
