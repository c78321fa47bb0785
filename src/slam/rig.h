#pragma once

#include "camera/pinhole_camera.h"
#include "cpslam/settings.h"
#include "features/scale_pyramid.h"
#include "optim/observation.h"

namespace cpslam {

/// What never changes during a run and every stage needs to know. Immutable, shared by all threads.
struct Rig {
  explicit Rig(const Settings& s)
      : settings(s),
        camera(s.camera),
        pyramid(s.orb.scale_factor, s.orb.n_levels),
        close_depth_m(s.tracking.th_depth * s.camera.bf / s.camera.fx),
        reprojection{s.camera.fx, s.camera.fy, s.camera.cx, s.camera.cy, s.camera.bf} {}

  Settings settings;
  PinholeCamera camera;
  ScalePyramid pyramid;
  double close_depth_m;  ///< up to here one view is enough to make a point
  ReprojectionCamera reprojection;
};

}  // namespace cpslam
