#pragma once

#include "cpslam/settings.h"

namespace cpslam {

/// The colour camera of TUM's freiburg1 sequences, strongly distorted.
inline CameraSettings tum1_camera() {
  CameraSettings s;
  s.fx = 517.306408;
  s.fy = 516.469215;
  s.cx = 318.643040;
  s.cy = 255.313989;
  s.k1 = 0.262383;
  s.k2 = -0.953104;
  s.p1 = -0.005358;
  s.p2 = 0.002628;
  s.k3 = 1.163314;
  return s;
}

}  // namespace cpslam
